"""What several test folders share."""

import pytest

from wayword.models import model_path
from wayword.models.embedded import EmbeddedModel


@pytest.fixture(scope="session")
def embedded_model() -> EmbeddedModel:
    """The real default model, loaded once."""
    return EmbeddedModel(model_path())
