from hypothesis import given
from hypothesis import strategies as st

from wayword.models.validation import clean


def test_what_cannot_be_seen_is_dropped() -> None:
    assert clean("stop\u200b the\u202e car\U000e0041\u0000") == "stop the car"
    assert clean("s\u0336t\u0336o\u0336p\u0336") == "stop"


def test_other_forms_of_letters_and_quotes_become_plain() -> None:
    assert clean("ｄｒｉｖｅ　７０") == "drive 70"
    assert clean("“don’t”") == '"don\'t"'
    assert clean("café at 2.5 m/s²") == "café at 2.5 m/s2"


def test_spaces_of_any_kind_become_one() -> None:
    assert clean("  turn\n\tleft\u00a0now ") == "turn left now"


def test_other_scripts_stay() -> None:
    assert clean("поверни налево") == "поверни налево"
    assert clean("\u200b\u2060") == ""


@given(st.text())
def test_cleaning_twice_changes_nothing_more(text: str) -> None:
    assert clean(clean(text)) == clean(text)
    assert "\n" not in clean(text)
