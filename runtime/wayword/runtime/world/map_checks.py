"""What a map's entries must fulfil together. Each complaint names its entry."""

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wayword.runtime.world.maps import Map

PLACE_MARGIN_M = 15.0
"""A place must be this far from the junctions' edges, so that a car can stop at it."""
SHORTEST_ROAD_M = 60.0
"""Least length of a road between the edges of its junctions."""


def check_consistency(town: "Map") -> None:
    """Check what no entry can say by itself.

    Raises:
        ValueError: At the first contradiction.
    """
    _refuse_duplicates("junctions", [junction.id for junction in town.junctions])
    _refuse_duplicates("places", [place.name for place in town.places])
    _check_roads(town)
    _check_junctions(town)
    _check_places(town)


def _refuse_duplicates(where: str, names: list[str]) -> None:
    for name, count in Counter(names).items():
        if count > 1:
            raise ValueError(f"{where}: {name!r} is there {count} times")


def _check_roads(town: "Map") -> None:
    known = {junction.id for junction in town.junctions}
    for number, road in enumerate(town.roads):
        where = f"roads[{number}] ({road.street}, {road.start} to {road.end})"
        for end in (road.start, road.end):
            if end not in known:
                raise ValueError(f"{where}: there is no junction {end!r}")
        if road.lanes != town.lanes:
            raise ValueError(f"{where}: every road must have as many lanes as the first, {town.lanes}")
        a, b = town.junction(road.start), town.junction(road.end)
        if (a.x == b.x) == (a.y == b.y):
            raise ValueError(f"{where}: a road must run straight along x or y between two junctions")
        free = town.road_length_m(road.start, road.end) - 2 * town.junction_half_size_m
        if free < SHORTEST_ROAD_M:
            raise ValueError(f"{where}: {free:g} m between its junctions, {SHORTEST_ROAD_M:g} m needed")
    _refuse_duplicates("roads", ["-".join(sorted((road.start, road.end))) for road in town.roads])


def _check_junctions(town: "Map") -> None:
    """Every junction needs two arms at least, and no two on the same side."""
    for junction in town.junctions:
        sides = []
        for road in town.roads:
            if junction.id in (road.start, road.end):
                other = town.junction(road.end if road.start == junction.id else road.start)
                sides.append((_sign(other.x - junction.x), _sign(other.y - junction.y)))
        if len(sides) < 2:
            raise ValueError(f"junctions: {junction.id} has {len(sides)} road(s); a dead end can't be left")
        if len(set(sides)) < len(sides):
            raise ValueError(f"junctions: two roads leave {junction.id} on the same side")
    _check_connected(town)


def _check_connected(town: "Map") -> None:
    reached = {town.junctions[0].id}
    while True:
        grown = reached | {
            end for road in town.roads for end in (road.start, road.end) if {road.start, road.end} & reached
        }
        if grown == reached:
            break
        reached = grown
    for junction in town.junctions:
        if junction.id not in reached:
            raise ValueError(f"junctions: no way leads from {town.junctions[0].id} to {junction.id}")


def _check_places(town: "Map") -> None:
    joined = {frozenset((road.start, road.end)) for road in town.roads}
    for place in town.places:
        if frozenset((place.start, place.end)) not in joined:
            raise ValueError(f"places: {place.name}: there is no road between {place.start} and {place.end}")
        lower = town.junction_half_size_m + PLACE_MARGIN_M
        upper = town.road_length_m(place.start, place.end) - lower
        if not lower <= place.position_m <= upper:
            raise ValueError(
                f"places: {place.name}: position_m is {place.position_m:g}, "
                f"but must lie between {lower:g} and {upper:g} on this road"
            )


def _sign(value: float) -> int:
    return (value > 0) - (value < 0)
