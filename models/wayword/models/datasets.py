"""The data sets that ship with Wayword."""

from pathlib import Path

DATA = Path(__file__).parent / "data"
TEST_SETS = ("benchmark", "dev", "activation", "attack", "lampilot")


def shipped_data(name: str) -> Path | None:
    """The file of a shipped data set, None where there is none of that name."""
    return DATA / f"{name}.jsonl" if name in TEST_SETS else None
