"""What decides whether an engine can run a grammar: emptiness, left recursion, finite sentences."""

from collections.abc import Callable, Iterator, Mapping

from wayword.grammar.ir import (
    Choice,
    Expression,
    Literal,
    Reference,
    Repeat,
    Rule,
    Sequence,
    parts,
    references,
    walk,
)

Rules = Mapping[str, Rule]


def is_nullable(expression: Expression, nullable: set[str]) -> bool:
    """Say whether an expression matches the empty string, given the names of the rules that do."""
    return _holds(expression, nullable, _is_empty)


def _is_empty(leaf: Expression) -> bool:
    return isinstance(leaf, Literal) and not leaf.text


def _holds(expression: Expression, names: set[str], of_leaf: Callable[[Expression], bool]) -> bool:
    """Say whether what holds of some leaves and rules holds of an expression made of them."""
    match expression:
        case Sequence(items):
            return all(_holds(item, names, of_leaf) for item in items)
        case Choice(alternatives):
            return any(_holds(each, names, of_leaf) for each in alternatives)
        case Repeat(body, low):
            return low == 0 or _holds(body, names, of_leaf)
        case Reference(name):
            return name in names
    return of_leaf(expression)


def _closure(rules: Rules, of_leaf: Callable[[Expression], bool]) -> set[str]:
    """Return the names of all rules of which it holds: the least fixed point."""
    names: set[str] = set()
    while True:
        found = {name for name, rule in rules.items() if _holds(rule.body, names, of_leaf)}
        if found == names:
            return names
        names = found


def nullable_rules(rules: Rules) -> set[str]:
    """Return the names of all rules that match the empty string."""
    return _closure(rules, _is_empty)


def left_corners(expression: Expression, nullable: set[str]) -> Iterator[str]:
    """Yield the rules with which a match can begin, once for each place in the expression."""
    if isinstance(expression, Reference):
        yield expression.name
    for part in parts(expression):
        yield from left_corners(part, nullable)
        if isinstance(expression, Sequence) and not is_nullable(part, nullable):
            return


def left_recursions(rules: Rules) -> list[tuple[str, ...]]:
    """Return the left-recursive cycles, each as the rules it goes through; every rule is in one at most."""
    nullable = nullable_rules(rules)
    corners = {name: tuple(dict.fromkeys(left_corners(rule.body, nullable))) for name, rule in rules.items()}
    cycles: list[tuple[str, ...]] = []
    for name in rules:
        if not any(name in cycle for cycle in cycles) and (cycle := _cycle(name, corners)):
            cycles.append(cycle)
    return cycles


def _cycle(start: str, successors: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """Return the shortest path from a rule back to itself, breadth first; empty where there is none."""
    reached_from: dict[str, str] = {}
    pending = [start]
    for current in pending:
        for successor in successors.get(current, ()):
            if successor == start:
                path = [current]
                while path[-1] != start:
                    path.append(reached_from[path[-1]])
                return tuple(reversed(path))
            if successor not in reached_from:
                reached_from[successor] = current
                pending.append(successor)
    return ()


def nullable_repetitions(rules: Rules) -> Iterator[tuple[Rule, Repeat]]:
    """Yield unbounded repetitions of what may be empty: an engine can repeat nothing for ever."""
    nullable = nullable_rules(rules)
    for rule in rules.values():
        for part in walk(rule.body):
            if isinstance(part, Repeat) and part.max is None and is_nullable(part.body, nullable):
                yield rule, part


def undefined_references(rules: Rules) -> Iterator[tuple[Rule, Reference]]:
    """Yield references to rules that don't exist."""
    for rule in rules.values():
        for reference in references(rule.body):
            if reference.name not in rules:
                yield rule, reference


def unproductive_rules(rules: Rules) -> list[Rule]:
    """Return the rules that derive no finite string."""
    productive = _closure(rules, lambda _: True)
    return [rule for name, rule in rules.items() if name not in productive]
