r"""Reads the smallest parts of GBNF: space, names, strings and character classes.

Escapes are those of llama.cpp: ``\n \r \t \\ \" \[ \] \- \xHH \uHHHH \UHHHHHHHH``.
"""

import re
from bisect import bisect_right

from wayword.grammar.diagnostics import Position
from wayword.grammar.ir import MAX_CODE_POINT, CharSet, char_set, complement

_SPACE = re.compile(r"(?:[ \t]|#[^\r\n]*)*")
_SPACE_AND_NEWLINES = re.compile(r"(?:[ \t\r\n]|#[^\r\n]*)*")
_WORD = re.compile(r"[^\s:=#\"\[\](){}|*+?.<>!]+")
_NAME = re.compile(r"[A-Za-z0-9-]+")
_RULE_HEAD = re.compile(_WORD.pattern + r"[ \t]*::=")
_SIMPLE_ESCAPES = {"t": "\t", "r": "\r", "n": "\n"} | {char: char for char in '\\"[]-'}
_HEX_DIGITS = {"x": 2, "u": 4, "U": 8}


class GbnfSyntaxError(Exception):
    """What stands at an offset is no GBNF, or not what llama.cpp would take it for."""

    def __init__(self, offset: int, construct: str, message: str, way_out: str) -> None:
        super().__init__(message)
        self.offset, self.construct, self.message, self.way_out = offset, construct, message, way_out


class Scanner:
    """A text and a place in it."""

    def __init__(self, text: str, file: str) -> None:
        self.offset = 0
        self._text = text
        self._file = file
        self._line_starts = [0, *(newline.end() for newline in re.finditer("\n", text))]

    @property
    def at_end(self) -> bool:
        """Whether the text is used up."""
        return self.offset >= len(self._text)

    def peek(self, characters: str) -> bool:
        """Say whether one of these characters comes next."""
        return not self.at_end and self._text[self.offset] in characters

    def next_character(self) -> str:
        """Take one character, whatever it is."""
        self.offset += 1
        return self._text[self.offset - 1]

    def take(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """Take what matches a pattern here, if anything does."""
        match = pattern.match(self._text, self.offset)
        if match:
            self.offset = match.end()
        return match

    def skip_space(self, *, newlines: bool) -> None:
        """Take space and comments."""
        self.take(_SPACE_AND_NEWLINES if newlines else _SPACE)

    def skip_to_next_rule(self) -> None:
        """Take everything before the next line that begins a rule."""
        while not self.at_end:
            line_end = self._text.find("\n", self.offset)
            self.offset = len(self._text) if line_end < 0 else line_end + 1
            if self.at_rule_head():
                return

    def at_rule_head(self) -> bool:
        """Say whether ``name ::=`` comes next."""
        return _RULE_HEAD.match(self._text, self.offset) is not None

    def position(self, offset: int) -> Position:
        """Return line and column of an offset."""
        line = bisect_right(self._line_starts, offset)
        return Position(self._file, line, offset - self._line_starts[line - 1] + 1)

    def name(self) -> str:
        """Take the name of a rule."""
        begin = self.offset
        word = self.take(_WORD)
        if word is None:
            found = self._text[begin]
            raise GbnfSyntaxError(begin, f"character {found!r}", "nothing begins with it here", "quote it")
        if not _NAME.fullmatch(word[0]):
            message = "a name has only letters, digits and hyphens"
            raise GbnfSyntaxError(begin, f"name {word[0]}", message, "replace the other characters by hyphens")
        return word[0]

    def string(self) -> str:
        """Take a string in quotes and return its text."""
        begin = self.offset
        self.offset += 1
        characters: list[str] = []
        while not self.peek('"'):
            characters.append(self._character(begin, "string"))
        self.offset += 1
        if "\0" in characters:
            raise GbnfSyntaxError(begin, "string", "it holds NUL, which ends a string in C", "leave NUL out")
        return "".join(characters)

    def char_class(self) -> CharSet:
        """Take a class in brackets and return its set."""
        begin = self.offset
        self.offset += 1
        negated = self.peek("^")
        self.offset += negated
        ranges: list[tuple[int, int]] = []
        while not self.peek("]"):
            ranges.append(self._range(begin))
        self.offset += 1
        if not ranges:
            message = "it is empty, and llama.cpp would take it for the empty string"
            raise GbnfSyntaxError(begin, "character class", message, "write . for any character")
        found = char_set(ranges, self.position(begin))
        return CharSet(complement(found.ranges), position=found.position) if negated else found

    def _range(self, begin: int) -> tuple[int, int]:
        low = high = ord(self._character(begin, "character class"))
        if self.peek("-") and self._text[self.offset + 1 : self.offset + 2] != "]":
            self.offset += 1
            high = ord(self._character(begin, "character class"))
        if high < low:
            message = f"its range {chr(low)}-{chr(high)} ends before it begins"
            raise GbnfSyntaxError(begin, "character class", message, "swap the ends")
        return low, high

    def _character(self, begin: int, construct: str) -> str:
        if self.at_end:
            raise GbnfSyntaxError(begin, construct, "it isn't closed", "close it")
        character = self.next_character()
        return character if character != "\\" else self._escape(self.offset - 1)

    def _escape(self, begin: int) -> str:
        kind = self._text[self.offset : self.offset + 1]
        self.offset += 1
        if kind in _SIMPLE_ESCAPES:
            return _SIMPLE_ESCAPES[kind]
        length = _HEX_DIGITS.get(kind, 0)
        digits = self._text[self.offset : self.offset + length]
        self.offset += length
        if not length or not re.fullmatch(f"[0-9A-Fa-f]{{{length}}}", digits):
            way_out = "write \\xHH, \\uHHHH or \\UHHHHHHHH"
            raise GbnfSyntaxError(begin, f"escape \\{kind}{digits}", "llama.cpp doesn't know it", way_out)
        if int(digits, 16) > MAX_CODE_POINT:
            raise GbnfSyntaxError(begin, f"escape \\{kind}{digits}", "no character has that code", "lower it")
        return chr(int(digits, 16))
