"""Plots of a recorded drive, made from its event log."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from wayword.runtime.recording import Event, read_log
from wayword.runtime.world import Map, load_map

_INK, _ROUTE, _LIMIT, _MARK = "#24292f", "#0969da", "#bc4c00", "#8250df"
_ROAD, _LANE_LINE = "#d0d7de", "#ffffff"


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
    axes.set(xlabel="time [s]", ylabel="velocity [km/h]", xlim=(0, max(times, default=1)), ylim=(0, None))
    axes.set_ylim(0, axes.get_ylim()[1] * 1.25)  # room for the labels of the instructions
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="upper right", frameon=False, ncols=3)
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
    for event in events:
        if event["event"] == "instruction":
            at = min(states, key=lambda state: abs(state["t"] - event["t"]))
            axes.annotate(
                event["id"],
                (at["x"], at["y"]),
                xytext=(6, 8),
                textcoords="offset points",
                color=_MARK,
                fontsize=9,
                fontweight="bold",
                zorder=5,
            )
            axes.plot(at["x"], at["y"], "o", color=_MARK, ms=5, zorder=4)
    axes.set_title(_title(events), loc="left", color=_INK, fontsize=11)
    _save(figure, target)


def _draw_map(axes: Axes, map_: Map) -> None:
    outline = map_.outline()
    axes.add_collection(LineCollection(outline.lanes, colors=_ROAD, linewidths=5, capstyle="round", zorder=1))
    axes.add_collection(LineCollection(outline.lanes, colors=_LANE_LINE, linewidths=0.4, zorder=2))
    axes.add_collection(LineCollection(outline.stop_lines, colors=_INK, linewidths=1.2, zorder=2))
    for name, (x, y) in outline.places.items():
        axes.plot(x, y, "s", color=_INK, ms=5, zorder=3)
        axes.annotate(name, (x, y), xytext=(5, -11), textcoords="offset points", color=_INK, fontsize=8, zorder=5)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.04)
    axes.invert_yaxis()  # the map's y axis points south
    axes.set_axis_off()


def _shade_lights(axes: Axes, states: list[Event]) -> None:
    """Shades the times at which the light ahead is taken for red while it truly is green."""
    labelled = False
    start: float | None = None
    for state in [*states, None]:
        misread = state is not None and state["light"] == "red" and state["true_light"] == "green"
        if misread and start is None and state is not None:
            start = state["t"]
        elif not misread and start is not None:
            end = state["t"] if state is not None else states[-1]["t"]
            label = None if labelled else "green light misread as red"
            axes.axvspan(start, end, color="#cf222e", alpha=0.12, lw=0, label=label)
            labelled, start = True, None


def _mark_instructions(axes: Axes, events: list[Event]) -> None:
    for event in events:
        if event["event"] == "instruction":
            axes.axvline(event["t"], color=_MARK, lw=1, ls=":")
            axes.annotate(
                f"{event['id']} {event['text']}",
                (event["t"], 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(3, -3),
                textcoords="offset points",
                rotation=90,
                va="top",
                fontsize=7.5,
                color=_MARK,
            )


def _title(events: list[Event]) -> str:
    session = next(event for event in events if event["event"] == "session")
    return f"scenario {session['scenario']}, seed {session['seed']}"


def _save(figure: Figure, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(target, dpi=130)
