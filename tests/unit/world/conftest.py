import pytest

from wayword.runtime.world import Map, load_map
from wayword.runtime.world.layout import build_network
from wayword.runtime.world.network import Network


@pytest.fixture(scope="session")
def town() -> Map:
    return load_map()


@pytest.fixture(scope="session")
def network(town: Map) -> Network:
    return build_network(town)
