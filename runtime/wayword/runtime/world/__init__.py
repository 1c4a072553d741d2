"""The simulated town: maps, traffic, perception with faults, and the driving stack of the passenger's car.

Maps and their drawing need no simulator: what does is imported when it is first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from wayword.runtime.world.maps import Map, MapError, load_map
from wayword.runtime.world.outline import LightPost, Outline

if TYPE_CHECKING:
    from wayword.runtime.world.perception import Fault
    from wayword.runtime.world.simulation import LightAhead, OtherCar, World
    from wayword.runtime.world.spawn import Placement

__all__ = [
    "Fault",
    "LightAhead",
    "LightPost",
    "Map",
    "MapError",
    "OtherCar",
    "Outline",
    "Placement",
    "World",
    "load_map",
]

_LAZY = {
    "Fault": "perception",
    "LightAhead": "simulation",
    "OtherCar": "simulation",
    "Placement": "spawn",
    "World": "simulation",
}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_LAZY[name]}"), name)
