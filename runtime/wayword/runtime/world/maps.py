"""Maps: what their files hold, how they are read and what is refused.

Nothing here needs the simulator, so that the names of places are at hand without it.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Self

import yaml
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from wayword.compiler.diagnostics import MALFORMED_PLACE
from wayword.compiler.values import is_place_name
from wayword.models.validation import explain
from wayword.runtime.world.map_checks import check_consistency

if TYPE_CHECKING:
    from wayword.runtime.world.outline import Outline

MAPS_FOLDER = Path(__file__).parent / "maps"

LANE_WIDTH_M = 4.0
RIGHT_TURN_RADIUS_M = 12.0
"""Radius of a right turn from the outermost lane; it sets how large a junction is."""


class MapError(Exception):
    """A map can't be used. The message names the file and the entry."""


def _place_name(name: str) -> str:
    """Check a place's name against language.md section 2."""
    if not is_place_name(name):
        raise ValueError(f"{name!r} is no place name: {MALFORMED_PLACE.explanation}")
    return name


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class SignalTiming(_Entry):
    """Durations of the phases of one approach.

    Attributes:
        green_s: Green.
        yellow_s: Yellow after it.
        all_red_s: Red for everyone before the next approach's green.
    """

    green_s: float = Field(gt=0)
    yellow_s: float = Field(gt=0)
    all_red_s: float = Field(ge=0)

    @property
    def phase_s(self) -> float:
        """Time from one approach's green to the next one's."""
        return self.green_s + self.yellow_s + self.all_red_s


class JunctionEntry(_Entry):
    """A junction, or a bend where only two roads meet.

    Attributes:
        id: Short identifier.
        name: Name for people.
        x: East of the origin, in m.
        y: South of the origin, in m.
    """

    id: str = Field(pattern=r"^[A-Za-z0-9_]+$")
    name: str = Field(min_length=1)
    x: float
    y: float


class RoadEntry(_Entry):
    """A road between two junctions, both ways.

    Attributes:
        start: Junction at one end.
        end: Junction at the other.
        street: Name of the street.
        lanes: Lanes per direction.
        limit_kmh: Legal limit.
    """

    start: str = Field(alias="from")
    end: str = Field(alias="to")
    street: str = Field(min_length=1)
    lanes: int = Field(ge=1, le=3)
    limit_kmh: float = Field(ge=10, le=130)


class PlaceEntry(_Entry):
    """A place at the right-hand kerb of one direction of a road.

    Attributes:
        name: Its name in the language.
        start: Junction that the direction comes from.
        end: Junction that it leads to.
        position_m: Distance from the middle of the junction `start`.
    """

    name: Annotated[str, AfterValidator(_place_name)]
    start: str = Field(alias="from")
    end: str = Field(alias="to")
    position_m: float = Field(gt=0)


class Map(_Entry):
    """A map as its file holds it.

    Attributes:
        name: Name of the map.
        signals: Timing of all traffic lights.
        junctions: Where roads meet.
        roads: The roads between them.
        places: Where trips begin and end.
    """

    name: str = Field(min_length=1)
    signals: SignalTiming
    junctions: tuple[JunctionEntry, ...] = Field(min_length=2)
    roads: tuple[RoadEntry, ...] = Field(min_length=1)
    places: tuple[PlaceEntry, ...] = Field(min_length=1)

    @property
    def place_names(self) -> tuple[str, ...]:
        """The names of the places, in the file's order."""
        return tuple(place.name for place in self.places)

    @property
    def lanes(self) -> int:
        """Lanes per direction, the same on every road."""
        return self.roads[0].lanes

    @property
    def junction_half_size_m(self) -> float:
        """Distance from a junction's middle to where its roads begin."""
        return RIGHT_TURN_RADIUS_M + LANE_WIDTH_M * (self.lanes - 0.5)

    def outline(self) -> "Outline":
        """The shape of the map, for drawing it."""
        from wayword.runtime.world.outline import outline_of  # it builds on this module

        return outline_of(self)

    def junction(self, identifier: str) -> JunctionEntry:
        """The junction of this identifier."""
        return next(junction for junction in self.junctions if junction.id == identifier)

    def road_length_m(self, start: str, end: str) -> float:
        """Distance between the middles of two junctions that a road joins."""
        a, b = self.junction(start), self.junction(end)
        return abs(a.x - b.x) + abs(a.y - b.y)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        check_consistency(self)
        return self


def load_map(name_or_path: str | Path = "town") -> Map:
    """Read a map.

    Args:
        name_or_path: The name of a built-in map, or the path of a file that ends in ``.yaml`` or ``.yml``.

    Raises:
        MapError: If it can't be read or isn't a good map; the message names file and entry.
    """
    path = Path(name_or_path)
    if path.suffix not in {".yaml", ".yml"}:
        path = MAPS_FOLDER / f"{name_or_path}.yaml"
        if not path.is_file():
            known = ", ".join(sorted(file.stem for file in MAPS_FOLDER.glob("*.yaml")))
            raise MapError(f"there is no map {str(name_or_path)!r}; built in: {known}")
    return _validated(path, _read(path))


def _read(path: Path) -> object:
    try:
        content: object = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise MapError(f"{path}: can't be read: {getattr(error, 'strerror', None) or error}") from None
    except (yaml.YAMLError, RecursionError) as error:
        raise MapError(f"{path}: is no YAML: {error}") from None
    return content


def _validated(path: Path, content: object) -> Map:
    try:
        return Map.model_validate(content)
    except ValidationError as error:
        raise MapError(f"{path}: {explain(error, Map)}") from None
