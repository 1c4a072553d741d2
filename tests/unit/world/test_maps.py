"""Maps: the built-in one is good, and a bad one is refused by name."""

import copy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.town import TOWN
from wayword.runtime.world import Map, MapError, load_map
from wayword.runtime.world.maps import MAPS_FOLDER


def test_the_town_names_the_places_of_the_language(town: Map) -> None:
    assert set(town.place_names) == set(TOWN)


def test_place_names_need_no_simulator() -> None:
    script = (
        "import sys\n"
        "from wayword.runtime.world import load_map\n"
        "load_map().outline()\n"
        "assert 'highway_env' not in sys.modules and 'gymnasium' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_the_outline_has_a_stop_line_for_every_light(town: Map) -> None:
    outline = town.outline()
    assert len(outline.stop_lines) == len(outline.lights) == 4 * 3 + 3 * 4
    assert set(outline.places) == set(TOWN)
    assert len(outline.lanes) == 2 * 2 * len(town.roads)


def _rename(content: Any, name: object) -> None:
    content["places"][0]["name"] = name


BAD: dict[str, tuple[Callable[[Any], object], str]] = {
    "yaml boolean": (lambda m: _rename(m, True), "places.0.name"),
    "quoted boolean": (lambda m: _rename(m, "Yes"), "'Yes' is no place name"),
    "keyword": (lambda m: _rename(m, "default"), "'default' is no place name"),
    "double space": (lambda m: _rename(m, "City  Hall"), "'City  Hall' is no place name"),
    "space at the end": (lambda m: _rename(m, "City "), "'City ' is no place name"),
    "digit first": (lambda m: _rename(m, "7th Street"), "'7th Street' is no place name"),
    "too long": (lambda m: _rename(m, "A" * 41), "is no place name"),
    "same place twice": (lambda m: _rename(m, "Harbor"), "'Harbor' is there 2 times"),
    "place off the road": (lambda m: m["places"][0].update(position_m=20), "places: Home: position_m is 20"),
    "place without road": (lambda m: m["places"][0].update({"to": "C5"}), "no road between C1 and C5"),
    "unknown junction": (lambda m: m["roads"][0].update({"to": "Z9"}), "there is no junction 'Z9'"),
    "slanting road": (lambda m: m["junctions"][0].update(x=5), "must run straight"),
    "short road": (lambda m: m["junctions"][0].update(x=150, y=0), "60 m needed"),
    "other lanes": (lambda m: m["roads"][3].update(lanes=1), "as many lanes as the first"),
    "dead end": (lambda m: m["roads"].pop(0), "A1 has 1 road(s)"),
    "same road twice": (lambda m: m["roads"].append(m["roads"][0]), "'A1-A2' is there 2 times"),
    "same junction twice": (lambda m: m["junctions"].append(m["junctions"][0]), "'A1' is there 2 times"),
    "unknown field": (lambda m: m.update(colour="green"), "colour"),
    "no timing": (lambda m: m.pop("signals"), "signals"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_map_is_refused_by_file_and_entry(case: str, tmp_path: Path) -> None:
    spoil, message = BAD[case]
    content = copy.deepcopy(yaml.safe_load((MAPS_FOLDER / "town.yaml").read_text()))
    spoil(content)
    file = tmp_path / "bad.yaml"
    file.write_text(yaml.safe_dump(content))
    with pytest.raises(MapError) as error:
        load_map(file)
    assert message in str(error.value)
    assert "bad.yaml" in str(error.value)


@pytest.mark.parametrize("text", ["{", "- 1", "", "\x00"])
def test_what_is_no_map_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text(text)
    with pytest.raises(MapError, match=r"bad\.yaml"):
        load_map(file)


def test_an_unknown_map_is_refused_with_the_known_ones() -> None:
    with pytest.raises(MapError, match="no map 'moon'; built in: town"):
        load_map("moon")
