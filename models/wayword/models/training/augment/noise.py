"""Speech and typing as they really arrive: fillers, courtesy, no punctuation, mis-heard words, slips of the finger."""

import re
from collections import Counter
from random import Random

from wayword.models.training.augment.numbers import find_numbers, say

_OPENERS = (
    "please", "hey", "hey car", "okay", "ok", "um", "uh", "so", "alright", "listen", "excuse me", "hi", "hello", "well",
    "right then", "sorry", "car", "hey there", "oh", "erm", "look", "and", "yeah", "okay so", "um so",
    "hey wayword", "good morning", "if you don't mind", "quick one", "hmm", "ah", "say", "oi", "listen up",
    "dear car", "one thing",
)  # fmt: skip
_CLOSERS = (
    "please", "thanks", "thank you", "if you can", "would you", "mate", "dear", "buddy", "okay", "will you", "cheers",
    "if you don't mind", "pretty please", "if that's alright", "man", "my friend", "thank you very much", "ta", "love",
    "yeah", "if possible", "darling", "sir", "for me",
)  # fmt: skip
_MISHEARD = {
    "lane": ("line", "lain", "lame"), "lanes": ("lines", "lains"), "brake": ("break",), "brakes": ("breaks",),
    "braking": ("breaking",), "right": ("write", "rite"), "red": ("read",), "green": ("greene",), "to": ("too", "two"),
    "the": ("da", "a"), "for": ("four",), "by": ("buy",), "way": ("weigh",), "road": ("rode",), "their": ("there",),
    "exit": ("exits", "exit it"), "curb": ("kerb",), "route": ("root",), "ahead": ("a head",), "behind": ("be hind",),
    "overtake": ("over take",), "pass": ("past",), "passed": ("past",), "slower": ("slow her",), "through": ("threw",),
    "wait": ("weight",), "gap": ("cap", "gab"), "speed": ("speech", "sped"), "left": ("lift",), "turn": ("term",),
    "stop": ("stopped",), "pull": ("pool",), "merge": ("murge",), "corner": ("coroner",), "bend": ("bent",),
    "lead": ("led",), "meters": ("metres", "meeters"), "here": ("hear",), "sign": ("sine",), "light": ("lite",),
    "accelerate": ("exhilarate",), "station": ("stationed",), "supermarket": ("super market",), "harbor": ("harbour",),
    "stadium": ("stadion",), "museum": ("museam",), "there": ("their",), "our": ("are",),
    "hour": ("our",), "aside": ("a side",), "car": ("car car",), "we": ("we we",), "is": ("is is",), "I": ("i i",),
}  # fmt: skip


def add_courtesy(sentence: str, rng: Random) -> str:
    """Puts an opener before the sentence, or a closer behind it."""
    if rng.random() < 0.6:
        opener = rng.choice(_OPENERS)
        if sentence[:1].isupper() and not sentence.startswith("I ") and not sentence.startswith("I'"):
            opener = opener[0].upper() + opener[1:]
            sentence = sentence[0].lower() + sentence[1:] if not sentence[1:2].isupper() else sentence
        return f"{opener}{rng.choice((', ', ' '))}{sentence}"
    body, stop = (sentence[:-1], sentence[-1]) if sentence[-1:] in ".!?" else (sentence, "")
    return f"{body}{rng.choice((', ', ' '))}{rng.choice(_CLOSERS)}{stop}"


def as_heard(sentence: str, rng: Random) -> str:
    """Writes a sentence as a speech recogniser does: small letters, no punctuation, often numbers in words."""
    if rng.random() < 0.7:
        for mention in reversed(find_numbers(sentence)):
            follower = sentence[mention.end : mention.end + 1]
            if sentence[mention.start].isdigit() and mention.value < 1000 and round(mention.value, 1) == mention.value:
                space = " " if follower.isalpha() else ""
                said = say(mention.value, rng, words=True) + space
                sentence = sentence[: mention.start] + said + sentence[mention.end :]
    heard = re.sub(r"(?<=\d)\.(?=\d)", "\x00", sentence.lower())
    heard = re.sub(r"[^\w\s'/^²\x00]", " ", heard).replace("\x00", ".")
    return " ".join(heard.split()) or sentence


def mishear(sentence: str, rng: Random) -> str:
    """Replaces one word by one that sounds like it, unless that makes another number: "to sixty" is not "two sixty"."""
    words = sentence.split(" ")
    candidates = [index for index, word in enumerate(words) if word.lower() in _MISHEARD]
    if not candidates:
        return sentence
    index = rng.choice(candidates)
    words[index] = rng.choice(_MISHEARD[words[index].lower()])
    misheard = " ".join(words)
    lost = Counter(_values(sentence)) - Counter(_values(misheard))
    return sentence if lost else misheard


def _values(sentence: str) -> list[float]:
    return [mention.value for mention in find_numbers(sentence)]


def mistype(sentence: str, rng: Random) -> str:
    """Drops, doubles or swaps a letter in one of the longer words."""
    spots = [match.start() for match in re.finditer(r"(?<=[a-z])[a-z](?=[a-z]{2})", sentence)]
    if not spots:
        return sentence
    spot = rng.choice(spots)
    letter, following = sentence[spot], sentence[spot + 1]
    slip = rng.choice(("", letter * 2, None))
    if slip is None:
        return sentence[:spot] + following + letter + sentence[spot + 2 :]
    return sentence[:spot] + slip + sentence[spot + 1 :]
