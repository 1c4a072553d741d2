"""Plots of evaluations."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wayword.models.evaluation.selective import RiskCoverage

_INK, _LINE, _MARK, _FREE = "#24292f", "#0969da", "#bc4c00", "#8250df"


def plot_risk_coverage(curve: RiskCoverage, threshold: float, target: Path, *, title: str) -> None:
    """Draws the share of errors over the share of instructions acted on, with the threshold marked.

    Args:
        curve: The curve.
        threshold: Confidence below which the co-pilot asks back.
        target: The PNG file to write.
        title: What the curve is of.
    """
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(100 * curve.coverage, 100 * curve.risk, color=_LINE, lw=1.8)
    kept = 100 * float((curve.confidence >= threshold).mean())
    axes.axvline(kept, color=_MARK, ls="--", lw=1.2)
    axes.annotate(
        f"ask back below {threshold:.2f}", (kept, 1), xycoords=("data", "axes fraction"), xytext=(-6, -12),
        textcoords="offset points", ha="right", color=_MARK, fontsize=9,
    )  # fmt: skip
    axes.set(xlabel="coverage: instructions acted on [%]", ylabel="risk: errors among these [%]", xlim=(0, 100))
    axes.set_ylim(0, max(1.0, 130 * float(curve.risk.max())))
    _finish(axes, f"Risk and coverage, {title}: area under the curve {curve.area:.4f}")
    figure.savefig(target, dpi=120)


def plot_latencies(latencies: Mapping[str, Sequence[float]], target: Path) -> None:
    """Draws a box plot of the latencies of several configurations.

    Args:
        latencies: Times in ms, by the name of the configuration.
        target: The PNG file to write.
    """
    names = list(latencies)
    figure = Figure(figsize=(8, 0.8 + 0.38 * len(names)), layout="constrained")
    axes = figure.add_subplot()
    seconds = [[value / 1000 for value in latencies[name]] for name in names]
    boxes = axes.boxplot(seconds, orientation="horizontal", whis=(5, 95), showfliers=False, patch_artist=True)
    for box, name in zip(boxes["boxes"], names, strict=True):
        box.set_facecolor(_FREE if name.endswith("free") else _LINE)
        box.set_alpha(0.55)
    axes.set_yticks(range(1, len(names) + 1), names)
    axes.invert_yaxis()
    axes.set(xlabel="latency of a translation [s]; box: quartiles, whiskers: 5th and 95th percentile", xlim=(0, None))
    _finish(axes, "Latency by configuration")
    figure.savefig(target, dpi=120)


def plot_training(steps: Sequence[int], losses: Sequence[float], dev: Mapping[int, float], target: Path) -> None:
    """Draws a run's loss and its accuracy on the development set.

    Args:
        steps: Numbers of the steps.
        losses: Their losses, in nats per token.
        dev: Accuracy by step, where it was measured.
        target: The PNG file to write.
    """
    figure = Figure(figsize=(8, 4.2), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(steps, losses, color=_LINE, lw=0.6, alpha=0.4)
    axes.plot(steps, _smoothed(losses), color=_LINE, lw=1.8, label="training loss")
    axes.set(xlabel="step", ylabel="loss [nats per token]", yscale="log")
    axes.yaxis.label.set_color(_LINE)
    if dev:
        right = axes.twinx()
        right.plot(list(dev), [100 * value for value in dev.values()], "o-", color=_MARK, lw=1.2, ms=4)
        right.set(ylabel="development set: exact programs, free [%]", ylim=(0, 100))
        right.yaxis.label.set_color(_MARK)
        right.spines["top"].set_visible(False)
    _finish(axes, "Fine-tuning")
    figure.savefig(target, dpi=120)


def _smoothed(values: Sequence[float], memory: float = 0.95) -> list[float]:
    """An exponential moving average."""
    smooth: list[float] = []
    for value in values:
        smooth.append(value if not smooth else memory * smooth[-1] + (1 - memory) * value)
    return smooth


def _finish(axes: Axes, title: str) -> None:
    axes.spines["top"].set_visible(False)
    axes.grid(alpha=0.25)
    axes.set_title(title, loc="left", color=_INK, fontsize=11)
