"""``wayword eval confidence``."""

from pathlib import Path

import click
from rich.markup import escape
from rich.table import Table

from wayword.cli.common import errors, friendly_errors, json_option, make_folder, model_options, print_json
from wayword.cli.evaluate.common import keep, percent, read_data, run, translators
from wayword.models import DatasetError, ModelError
from wayword.models.confidence import ASK_BACK_BELOW
from wayword.models.evaluation.plots import plot_risk_coverage
from wayword.models.evaluation.selective import choose_threshold, risk_coverage


@click.command()
@click.argument("data", default="benchmark")
@click.option("--dev", default="dev", show_default=True, help="Data that the threshold is chosen on.")
@model_options
@click.option("--out", type=click.Path(path_type=Path), default=Path("out/eval"), show_default=True)
@json_option
@friendly_errors(DatasetError, ModelError)
def confidence(data: str, dev: str, model: str | None, adapter: str | None, out: Path, as_json: bool) -> None:
    """Draw the risk–coverage curve of asking back where the model is unsure.

    The confidence is the probability that the model gives to its whole program. The threshold below which the
    co-pilot asks back is chosen on the development data; the curve is that of DATA.
    """
    dev_records, records = read_data(dev), read_data(data)
    make_folder(out)
    translator_for = translators(model, adapter, None)
    chosen = choose_threshold(run(translator_for, dev_records, title=Path(dev).stem))
    results = run(translator_for, records, title=Path(data).stem)
    curve = risk_coverage(results)
    acted = [result for result in results if result.confidence >= chosen]
    report = {
        "data": data,
        "n": len(results),
        "threshold_from_dev": round(chosen, 4),
        "threshold_in_use": ASK_BACK_BELOW,
        "coverage_at_threshold": round(len(acted) / len(results), 4),
        "accuracy_at_threshold": round(sum(r.correct for r in acted) / max(1, len(acted)), 4),
        "accuracy": round(curve.accuracy_at(1.0), 4),
        "accuracy_at_coverage": {f"{share:.2f}": round(curve.accuracy_at(share), 4) for share in (0.8, 0.9, 0.95, 1)},
        "area_under_risk_coverage": round(curve.area, 5),
        "curve": [
            {"coverage": round(float(c), 4), "risk": round(float(r), 4), "confidence": round(float(p), 4)}
            for c, r, p in zip(curve.coverage, curve.risk, curve.confidence, strict=True)
        ],
    }
    kept = keep(out, f"confidence-{Path(data).stem}.json", report)
    picture = out / f"risk-coverage-{Path(data).stem}.png"
    plot_risk_coverage(curve, chosen, picture, title=Path(data).stem)
    if as_json:
        print_json(report)
        return
    table = Table("coverage", "accuracy", box=None)
    for share in (0.8, 0.9, 0.95, 1.0):
        table.add_row(percent(share), percent(curve.accuracy_at(share)))
    errors.print(table)
    errors.print(
        f"threshold from {escape(dev)}: {chosen:.3f}; it acts on {percent(report['coverage_at_threshold'])} "
        f"with accuracy {percent(report['accuracy_at_threshold'])}"
    )
    errors.print(f"[dim]report in {escape(str(kept))}, plot in {escape(str(picture))}[/]")
