"""Plain sentences for the passenger, made from execution reports and nothing else."""

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from importlib.resources import files

import yaml

from wayword.compiler import Diagnostic
from wayword.compiler.vocabulary import DRIVING_PARAMETERS
from wayword.runtime.answers import listed
from wayword.runtime.outcome import CommandReport, Outcome
from wayword.runtime.vehicle import FactValue

_PARAMETER = re.compile(rf"\b({'|'.join(DRIVING_PARAMETERS)})\b")


def feedback(reports: Sequence[CommandReport]) -> str:
    """Says what became of a program: a sentence for each command, one for all that were not started."""
    sentences = [sentence(report) for report in reports if report.outcome is not Outcome.CANCELLED]
    left_out = [_spoken_action(report.command.action.name) for report in reports if report.outcome is Outcome.CANCELLED]
    if left_out:
        sentences.append(_fill(_table("general")["cancelled"], {"actions": listed(left_out)}))
    return " ".join(sentences)


def sentence(report: CommandReport) -> str:
    """Says what became of one command that was started."""
    action = report.command.action.name
    facts = {**report.facts, "action": _spoken_action(action)}
    if report.outcome is Outcome.SUCCEEDED:
        text = _answer(facts) if action == "QUERY" else _fill(_pick(_table("succeeded"), action, facts), facts)
        return _capitalised(text)
    if report.outcome in (Outcome.REFUSED, Outcome.FAILED):
        return _fill(_table(report.outcome)[str(report.rationale)], facts)
    return _capitalised(_fill(_table("general")[report.outcome], facts))


def not_understood() -> str:
    """What to say where no program came of an instruction."""
    return _table("general")["not_understood"]


def not_compiled(diagnostics: Sequence[Diagnostic]) -> str:
    """What to say where a program has errors: the first one's message and help."""
    first = diagnostics[0]
    facts = {
        "message": first.message.replace("`", ""),
        "help": _capitalised((first.help or "").replace("`", "")),
    }
    return _fill(_table("general")["not_compiled"], facts).strip()


def _answer(facts: Mapping[str, FactValue]) -> str:
    item = str(facts["item"])
    if item == "operation_mode":
        return _table("modes")[str(facts["mode"])]
    if item == "reason":
        return _reason(facts)
    return _fill(_pick(_table("answers"), item, facts), facts)


def _reason(facts: Mapping[str, FactValue]) -> str:
    """Says which constraint limits the vehicle's motion, from the planner's trace."""
    constraint = str(facts["constraint"])
    if constraint == "leader" and facts.get("leader_kmh") == 0:
        constraint = "leader.standing"
    return _fill(_table("reasons")[constraint], facts)


def _pick(texts: Mapping[str, str], key: str, facts: Mapping[str, FactValue]) -> str:
    """The wording for a key, the one of its variant where the facts name one."""
    variant = facts.get("variant")
    return texts[f"{key}.{variant}" if variant else key]


def _fill(text: str, facts: Mapping[str, FactValue]) -> str:
    """Puts the facts into a text; parameters get the names that they have in speech."""
    return _PARAMETER.sub(lambda match: _table("parameters")[match[0]], text.format_map(facts))


def _spoken_action(action: str) -> str:
    return _table("actions")[action]


def _capitalised(text: str) -> str:
    return text[:1].upper() + text[1:]


def _table(name: str) -> dict[str, str]:
    return _texts()[name]


@lru_cache(maxsize=1)
def _texts() -> dict[str, dict[str, str]]:
    text = files("wayword.runtime").joinpath("texts/en.yaml").read_text(encoding="utf-8")
    loaded: dict[str, dict[str, str]] = yaml.safe_load(text)
    return loaded
