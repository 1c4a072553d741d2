"""Every action of the language, compiled to instructions."""

import pytest

from tests.programs import program
from wayword.compiler import compile_program
from wayword.compiler.vocabulary import ACTIONS, DRIVING_PARAMETERS, QUERY_ITEMS

CASES = [
    (program("QUERY", item="speed"), ["DO      answer item=speed"]),
    (
        program("SET_DESTINATION", destination="Main Station"),
        ['REQUIRE place_reachable place="Main Station"', 'DO      set_destination place="Main Station"'],
    ),
    (
        program("ADD_WAYPOINT", waypoint="Library"),
        ['REQUIRE place_reachable place="Library"', 'DO      add_waypoint place="Library"'],
    ),
    (
        program("REMOVE_WAYPOINT", waypoint="Library"),
        ['REQUIRE waypoint_planned place="Library"', 'DO      remove_waypoint place="Library"'],
    ),
    (program("REMOVE_WAYPOINT"), ["REQUIRE waypoint_planned", "DO      remove_waypoint"]),
    (
        program("START"),
        ["REQUIRE destination_known", "DO      start", "AWAIT   autonomous timeout=10 s"],
    ),
    (program("STOP"), ["DO      stop", "AWAIT   standstill timeout=60 s"]),
    (program("SET_PARAM", max_vel="90 km/h"), ["DO      set_parameter name=max_vel, value=25 m/s"]),
    (
        program("SET_PARAM", following_distance="60 ft"),
        [
            "REQUIRE headway_in_bounds length=18.288 m",
            "DO      set_parameter name=following_distance, value=18.288 m",
        ],
    ),
    (
        program("SET_PARAM", following_distance="default"),
        ["DO      set_parameter name=following_distance, value=1.8 s"],
    ),
    (
        program("SET_PARAM", driving_style="calm"),
        [
            "DO      set_parameter name=driving_style, value=calm",
            "DO      set_parameter name=max_accel, value=1 m/s^2",
            "DO      set_parameter name=max_decel, value=1.5 m/s^2",
            "DO      set_parameter name=max_lat_accel, value=1.2 m/s^2",
            "DO      set_parameter name=following_distance, value=2.5 s",
        ],
    ),
    (program("SET_PARAM", preferred_lane="left"), ["DO      set_parameter name=preferred_lane, value=left"]),
    (program("SET_PARAM", all="default"), ["DO      reset_parameters"]),
    (
        program("ADJUST_PARAM", max_vel="increase"),
        ["DO      adjust_parameter name=max_vel, delta=2.777777778 m/s"],
    ),
    (
        program("ADJUST_PARAM", following_distance="decrease"),
        ["DO      adjust_parameter name=following_distance, delta=-0.5 s"],
    ),
    (
        program("ADJUST_PARAM", max_vel="-10 mph"),
        ["DO      adjust_parameter name=max_vel, delta=-4.4704 m/s"],
    ),
    (
        program("CHANGE_LANE", direction="left"),
        [
            "REQUIRE under_way",
            "REQUIRE lane_exists direction=left",
            "DO      change_lane direction=left",
            "AWAIT   lane_changed direction=left, timeout=60 s",
        ],
    ),
    (
        program("OVERTAKE", side="left"),
        ["REQUIRE under_way", "DO      overtake side=left", "AWAIT   leader_passed side=left, timeout=120 s"],
    ),
    (
        program("TURN", direction="straight"),
        [
            "REQUIRE under_way",
            "DO      turn direction=straight",
            "AWAIT   junction_passed direction=straight, timeout=240 s",
        ],
    ),
    (
        program("TAKE_EXIT", number="2"),
        ["REQUIRE under_way", "DO      take_exit number=2", "AWAIT   exit_taken number=2, timeout=240 s"],
    ),
    (program("PULL_OVER"), ["REQUIRE under_way", "DO      pull_over", "AWAIT   standstill timeout=120 s"]),
    (program("KEEP_LANE"), ["DO      keep_lane"]),
    (program("GIVE_WAY"), ["REQUIRE under_way", "DO      give_way", "AWAIT   way_given timeout=60 s"]),
    (
        program("OVERRIDE_TRAFFIC_LIGHT", state="green"),
        ["REQUIRE traffic_light_seen state=green", "DO      override_traffic_light state=green"],
    ),
    (
        program("OVERRIDE_SPEED_LIMIT", limit="50 km/h"),
        ["DO      override_speed_limit limit=13.88888889 m/s"],
    ),
    (
        program("IGNORE_OBJECT", position="ahead"),
        ["REQUIRE object_perceived position=ahead", "DO      ignore_object position=ahead"],
    ),
    (
        program("REPORT_OBJECT", position="left", distance="30 m"),
        ["DO      report_object position=left, distance=30 m"],
    ),
    (program("PROCEED"), ["REQUIRE waiting", "DO      proceed", "AWAIT   moving timeout=60 s"]),
    (program("EMERGENCY_STOP"), ["DO      emergency_stop", "AWAIT   standstill timeout=60 s"]),
    (program("REJECT", reason="unsafe"), ["DO      reject reason=unsafe"]),
    (program("CLARIFY", about="direction"), ["DO      ask about=direction"]),
]


@pytest.mark.parametrize(("source", "expected"), CASES)
def test_action_becomes_instructions(source: str, expected: list[str]) -> None:
    result = compile_program(source)
    assert not result.diagnostics
    (command,) = result.commands
    assert [str(instruction) for instruction in command.instructions] == expected


def test_every_action_is_in_the_cases() -> None:
    tested = {command.command.action.name for source, _ in CASES for command in compile_program(source).commands}
    assert tested == set(ACTIONS)


@pytest.mark.parametrize("item", QUERY_ITEMS)
def test_every_query_item_compiles(item: str) -> None:
    assert compile_program(program("QUERY", item=item)).ok


@pytest.mark.parametrize("name", DRIVING_PARAMETERS)
def test_every_driving_parameter_has_a_default_that_compiles(name: str) -> None:
    parameter = DRIVING_PARAMETERS[name]
    by_word = compile_program(program("SET_PARAM", **{name: "default"}))
    by_value = compile_program(program("SET_PARAM", **{name: str(parameter.default)}))
    assert [c.instructions for c in by_word.commands] == [c.instructions for c in by_value.commands]


def test_commands_keep_their_order_and_lines() -> None:
    source = program("START") + "---\n" + program("TURN", direction="left") + "---\n" + program("STOP")
    result = compile_program(source)
    assert [(c.command.action.name, c.command.span.line if c.command.span else 0) for c in result.commands] == [
        ("START", 1),
        ("TURN", 4),
        ("STOP", 10),
    ]
