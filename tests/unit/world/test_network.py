"""The lane graph, routes, and lights that never let conflicting flows go."""

import math

import pytest

from wayword.runtime.world import Map
from wayword.runtime.world.network import Link, Network
from wayword.runtime.world.router import RouteTable
from wayword.runtime.world.signals import SignalController


def test_connectors_join_their_lanes_smoothly(network: Network) -> None:
    for segment in network.segments():
        if segment.exit is None:
            continue
        (lane,) = segment.feeders
        assert math.dist(lane.curve.point(lane.length), segment.curve.point(0)) < 1e-6
        assert math.dist(segment.curve.point(segment.length), segment.exit.curve.point(0)) < 1e-6
        turn = segment.curve.heading_at(segment.length) - segment.exit.curve.heading_at(0)
        assert abs(math.remainder(turn, 2 * math.pi)) < 1e-9


def test_projection_inverts_the_curve(network: Network) -> None:
    for segment in network.segments():
        s, offset = segment.length / 3, 0.7
        assert segment.curve.project(*segment.curve.point(s, offset)) == pytest.approx((s, offset))


def test_every_junction_of_three_or_more_arms_has_lights(network: Network) -> None:
    lit = {junction.id for junction in network.junctions.values() if junction.signalised}
    assert lit == {"A4", "B1", "B2", "B3", "B4", "B5", "C2"}
    for segment in network.segments():
        expected = segment.kind == "road" and segment.junction.signalised
        assert (segment.stop_line is not None) is expected


def test_crossing_ways_conflict_and_parallel_ones_do_not(network: Network) -> None:
    lanes = {link: network.links[link].lanes for link in ("B2>B3", "A3>B3", "B4>B3")}
    straight_on = lanes["B2>B3"][1].connectors["straight"]
    assert lanes["A3>B3"][0].connectors["straight"] in straight_on.conflicts
    assert lanes["B4>B3"][0].connectors["straight"] not in straight_on.conflicts
    assert lanes["B2>B3"][0].connectors["straight"] not in straight_on.conflicts
    assert [sibling.movement for sibling, _ in straight_on.siblings] == ["right"]


def test_conflicts_are_mutual(network: Network) -> None:
    for segment in network.segments():
        assert all(segment in other.conflicts for other in segment.conflicts)


def _walk(table: RouteTable, link: Link) -> list[str]:
    ids = [link.id]
    while link is not table.goal:
        link = table.onward(link)
        ids.append(link.id)
    return ids


def test_the_route_is_the_quickest(network: Network, town: Map) -> None:
    table = RouteTable(network, network.links["B3>A3"], town.signals)
    assert _walk(table, network.links["C1>B1"]) == ["C1>B1", "B1>B2", "B2>B3", "B3>A3"]


def test_every_link_leads_to_every_other_one(network: Network, town: Map) -> None:
    for goal in network.links.values():
        table = RouteTable(network, goal, town.signals)
        for link in network.links.values():
            ids = _walk(table, link)
            assert len(ids) == len(set(ids))
            assert table.cost(link) >= 0.0


def test_from_the_goal_link_the_way_leads_back_to_it(network: Network, town: Map) -> None:
    goal = network.links["B3>A3"]
    table = RouteTable(network, goal, town.signals)
    assert _walk(table, table.onward(goal))[-1] == goal.id


@pytest.mark.parametrize("junction", ["B3", "C2"])
def test_at_most_one_approach_may_go(network: Network, town: Map, junction: str) -> None:
    controller = SignalController(network.junctions[junction], town.signals, offset_s=3.7)
    for tenth in range(round(controller.cycle_s * 10)):
        states = [controller.state(link, tenth / 10) for link in controller.junction.incoming]
        assert sum(state != "red" for state in states) <= 1


def test_green_turns_yellow_turns_red_for_the_planned_time(network: Network, town: Map) -> None:
    controller = SignalController(network.junctions["B3"], town.signals, offset_s=0.0)
    approach = controller.junction.incoming[1]
    begin = town.signals.phase_s
    assert controller.state(approach, begin - 0.1) == "red"
    assert controller.remaining_s(approach, begin - 0.1) == pytest.approx(0.1)
    assert controller.state(approach, begin) == "green"
    assert controller.remaining_s(approach, begin) == pytest.approx(town.signals.green_s)
    assert controller.state(approach, begin + town.signals.green_s) == "yellow"
    assert controller.state(approach, begin + town.signals.green_s + town.signals.yellow_s) == "red"
