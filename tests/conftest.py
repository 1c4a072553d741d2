"""What several test folders share."""

import pytest

from wayword.models import find_weights, model_path
from wayword.models.embedded import EmbeddedModel


@pytest.fixture(scope="session")
def embedded_model() -> EmbeddedModel:
    """The bare default model, loaded once."""
    return EmbeddedModel(model_path())


@pytest.fixture(scope="session")
def tuned_model() -> EmbeddedModel:
    """The default model with its adapter, loaded once."""
    return EmbeddedModel(find_weights().path)
