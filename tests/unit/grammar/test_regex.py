"""A translated regular expression matches what Python's engine matches."""

import re
from itertools import product

import pytest

from wayword.grammar.ir import CharSet
from wayword.grammar.recognise import matches
from wayword.grammar.regex import RegexError, ignoring_case, translate

TEXTS = ["".join(letters) for length in range(5) for letters in product("abA1\n-", repeat=length)]


@pytest.mark.parametrize(
    ("pattern", "flags"),
    [
        ("ab", ""),
        ("a|b|ab", ""),
        ("(a|b)*", ""),
        ("(?:a|)b", ""),
        ("(?P<name>a)b?", ""),
        ("a{2}b{1,2}", ""),
        ("a{2,}", ""),
        ("a{,2}b", ""),
        ("a*?b+?", ""),
        ("[ab-]+", ""),
        ("[^ab]{1,3}", ""),
        ("[^a]", ""),
        ("[-a]|[\\]1]", ""),
        (".{2}", ""),
        (".{2}", "s"),
        ("(?s:.)(?-s:.)", ""),
        ("ab", "i"),
        ("[^a]b", "i"),
        ("[a-b]+", "i"),
        ("(?i:a)b", ""),
        ("(?-i:a)b", "i"),
        ("(?a:\\d\\w*)", ""),
        ("(?a:[\\s\\d]\\D)", ""),
        ("(?a:[^\\w])", ""),
        ("a  b", "x"),
        ("a", "mu"),
    ],
)
def test_same_language_as_python(pattern: str, flags: str) -> None:
    compiled = re.compile(pattern, _bits(flags))
    expression = translate(pattern, flags)
    for text in TEXTS:
        assert matches({}, expression, text) == bool(compiled.fullmatch(text)), text


def _bits(flags: str) -> int:
    return sum(int(re.RegexFlag[flag.upper()]) for flag in flags)


@pytest.mark.parametrize("char", ["k", "K", "s", "i", "ß", "µ", "σ", "1", "é", "\u212a"])
def test_ignoring_case_as_python_does(char: str) -> None:
    expression = translate(re.escape(char), "i")
    assert isinstance(expression, CharSet)
    found = {chr(code) for low, high in expression.ranges for code in range(low, high + 1)}
    everything = "".join(map(chr, range(0x110000)))
    assert found == set(re.findall(re.escape(char), everything, re.IGNORECASE))


def test_ascii_case_is_narrower() -> None:
    kelvin = ((0x212A, 0x212A),)
    assert set(kelvin) < set(ignoring_case(((ord("k"), ord("k")),)))
    expression = translate("(?a:k)", "i")
    assert expression == translate("[kK]")


@pytest.mark.parametrize("pattern", ["(?i)a", "a(", "[b-a]", "a{3,1}"])
def test_malformed(pattern: str) -> None:
    with pytest.raises(RegexError):
        translate(f"x{pattern}")


def test_way_out_of_a_unicode_category() -> None:
    with pytest.raises(RegexError) as caught:
        translate(r"\W")
    assert caught.value.help == r"write [^A-Za-z0-9_] or (?a:\W)"
