"""Plots of a recorded drive, made from its event log."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from wayword.runtime.recording import Event, read_log
from wayword.runtime.world import Map, load_map

_INK, _ROUTE, _LIMIT, _MARK = "#24292f", "#0969da", "#bc4c00", "#8250df"
_ROAD, _LANE_LINE = "#d0d7de", "#ffffff"
_HALO = {"facecolor": "white", "edgecolor": "none", "alpha": 1.0, "pad": 0.8}
_MOST_SENTENCES, _LABEL_ROWS = 8, 4


def plot_velocity(log: Path, target: Path) -> None:
    """Draws the velocity over time, with the legal limit and the instructions marked.

    Args:
        log: An event log.
        target: The PNG file to write.

    Raises:
        LogError: The log can't be read.
    """
    events = list(read_log(log))
    states = [event for event in events if event["event"] == "state"]
    times = [state["t"] for state in states]
    figure = Figure(figsize=(11, 4.8), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(times, [state["limit"] * 3.6 for state in states], color=_LIMIT, lw=1.2, ls="--", label="legal limit")
    axes.plot(times, [state["speed"] * 3.6 for state in states], color=_ROUTE, lw=1.8, label="velocity")
    _shade_lights(axes, states)
    _mark_instructions(axes, events)
    axes.set(xlabel="time [s]", ylabel="velocity [km/h]", xlim=(0, max([1.0, *times])), ylim=(0, None))
    axes.set_ylim(0, axes.get_ylim()[1] * 1.4)  # room for the labels of the instructions
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False, ncols=4, fontsize=9)
    axes.set_title(_title(events), loc="left", color=_INK, fontsize=11)
    _save(figure, target)


def plot_map(log: Path, target: Path) -> None:
    """Draws the map with the driven route and where each instruction was given.

    Args:
        log: An event log.
        target: The PNG file to write.

    Raises:
        LogError: The log can't be read.
    """
    events = list(read_log(log))
    session = next(event for event in events if event["event"] == "session")
    figure = Figure(figsize=(11, 6), layout="constrained")
    axes = figure.add_subplot()
    _draw_map(axes, load_map(session["map"]))
    states = [event for event in events if event["event"] == "state"]
    axes.plot([s["x"] for s in states], [s["y"] for s in states], color=_ROUTE, lw=2.2, zorder=3)
    _mark_places_of_instructions(axes, events, states)
    axes.set_title(_title(events), loc="left", color=_INK, fontsize=11)
    _save(figure, target)


def _mark_places_of_instructions(axes: Axes, events: list[Event], states: list[Event]) -> None:
    for event in _instructions(events):
        at = min(states, key=lambda state: abs(state["t"] - event["t"]))
        axes.plot(at["x"], at["y"], "o", color=_MARK, ms=5, zorder=4, label=_plain(f"{event['id']}  {event['text']}"))
        axes.annotate(
            event["id"],
            (at["x"], at["y"]),
            xytext=(0, 9),
            textcoords="offset points",
            ha="center",
            color=_MARK,
            fontsize=9,
            fontweight="bold",
            bbox=_HALO,
            zorder=5,
        )
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, frameon=False, fontsize=8, markerscale=0)


def _instructions(events: list[Event]) -> list[Event]:
    return [event for event in events if event["event"] == "instruction"]


def _draw_map(axes: Axes, map_: Map) -> None:
    outline = map_.outline()
    paved = [_band(line, outline.lane_width_m / 2) for line in (*outline.lanes, *outline.connectors)]
    axes.add_collection(PolyCollection(paved, facecolors=_ROAD, edgecolors=_ROAD, linewidths=0.8, zorder=1))
    axes.add_collection(LineCollection(outline.edges, colors=_LANE_LINE, linewidths=0.7, zorder=2))
    axes.add_collection(LineCollection(outline.stop_lines, colors=_INK, linewidths=1.4, zorder=2))
    for name, (x, y) in outline.places.items():
        axes.plot(x, y, "s", color=_INK, ms=5, zorder=3)
        axes.annotate(
            name, (x, y), xytext=(7, -13), textcoords="offset points", color=_INK, fontsize=8, bbox=_HALO, zorder=2.5
        )
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.03)
    axes.invert_yaxis()  # the map's y axis points south
    axes.set_axis_off()


def _band(line: Sequence[tuple[float, float]], half_width: float) -> NDArray[np.float64]:
    """The area within half a width of a line, as a polygon of shape (2 n, 2)."""
    points = np.asarray(line, dtype=np.float64)
    along = np.gradient(points, axis=0)
    normal = np.column_stack((-along[:, 1], along[:, 0])) / np.linalg.norm(along, axis=1, keepdims=True)
    return np.concatenate((points + half_width * normal, (points - half_width * normal)[::-1]))


def _shade_lights(axes: Axes, states: list[Event]) -> None:
    """Shades the times at which the vehicle waits at a red light, truly red or not."""

    def waits(state: Event, *true_lights: str) -> bool:
        standing = state["speed"] < 0.1 and state["binding"] == "red_light"
        return standing and state["light"] == "red" and state["true_light"] in true_lights

    _shade(axes, states, lambda state: waits(state, "red", "yellow"), "#6e7781", "waiting at a red light")
    _shade(axes, states, lambda state: waits(state, "green"), "#cf222e", "green light misread as red")


def _shade(axes: Axes, states: list[Event], holds: Callable[[Event], bool], colour: str, label: str) -> None:
    where = [holds(state) for state in states]
    if any(where):
        times, height = [state["t"] for state in states], axes.get_xaxis_transform()
        axes.fill_between(times, 0, 1, where=where, transform=height, color=colour, alpha=0.14, lw=0, label=label)


def _mark_instructions(axes: Axes, events: list[Event]) -> None:
    """Marks when each instruction was given; where there are many, by its name alone."""
    given = _instructions(events)
    late = 0.7 * max(event["t"] for event in events)
    for number, event in enumerate(given):
        side = "left" if event["t"] < late else "right"
        text = event["id"] if len(given) > _MOST_SENTENCES else f"{event['id']} {event['text']}"
        axes.axvline(event["t"], color=_MARK, lw=1, ls=":")
        axes.annotate(
            _plain(text),
            (event["t"], 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(4 if side == "left" else -4, -12 - 13 * (number % _LABEL_ROWS)),  # neighbours on different heights
            textcoords="offset points",
            fontsize=8,
            color=_MARK,
            ha=side,
            bbox=_HALO,
            zorder=6,
        )


def _plain(text: str) -> str:
    """A text as it is: between two dollar signs matplotlib would read a formula."""
    return text.replace("$", r"\$")


def _title(events: list[Event]) -> str:
    session = next(event for event in events if event["event"] == "session")
    return f"scenario {session['scenario']}, seed {session['seed']}"


def _save(figure: Figure, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(target, dpi=130)
