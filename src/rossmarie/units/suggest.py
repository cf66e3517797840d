"""Suggests the unit that the user probably meant."""

from __future__ import annotations

import re
from collections.abc import Callable

from rossmarie.units.table import ALIASES, EVERYDAY, FACTORS, SPELLED_OUT, SYMBOLS

_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹·", "-0123456789*")
_MOST_SUGGESTIONS = 3
_LONGEST = 32


def suggest(text: str, is_unit: Callable[[str], bool]) -> tuple[str, ...]:
    """Known units that resemble the unknown `text`, best first; `is_unit` says whether a unit is
    known.
    """
    if len(text) > _LONGEST or factor_of(text) is not None:
        return ()
    everyday = EVERYDAY.get(text.lower())
    if everyday is not None:
        return (everyday,)
    respelled = _respell(text)
    parts = re.split(r"([.*/])", respelled)
    choices = [[part] if part in ".*/" else _replacements(part, is_unit) for part in parts]
    if not all(choices):
        return ()
    best = [choice[0] for choice in choices]
    found = {"".join(best): None}
    for index, choice in enumerate(choices):
        for replacement in choice[1:]:
            found["".join([*best[:index], replacement, *best[index + 1 :]])] = None
    return tuple(unit for unit in found if is_unit(unit))[:_MOST_SUGGESTIONS]


def factor_of(text: str) -> str | None:
    """The value of an unsupported unit in supported units: `1 inch is 2.54 cm`."""
    return FACTORS.get(text.lower())


def _respell(text: str) -> str:
    """Replace other notations of products and powers: `m²`, `m**2`, `1/s`, `kg·m`."""
    text = re.sub(r"([⁻⁰¹²³⁴-⁹]+)", r"^\1", text).translate(_SUPERSCRIPTS)
    text = text.replace("**", "^").replace(" ", "")
    if text == "1/s":
        return "Hz"
    return re.sub(r"^1/(\w+)$", r"\1^-1", text)


def _replacements(part: str, is_unit: Callable[[str], bool]) -> list[str]:
    """The replacements for one factor; the factor itself if it is correct."""
    if is_unit(part):
        return [part]
    symbol, caret, exponent = part.partition("^")
    if is_unit(symbol):
        return []
    found = [name + caret + exponent for name in _symbols_like(symbol)]
    power = re.fullmatch(r"(\D+)(-?[2-9])", symbol)
    if power and not caret:
        found.insert(0, f"{power[1]}^{power[2]}")
    return [replacement for replacement in found if is_unit(replacement)]


def _symbols_like(symbol: str) -> list[str]:
    lowered = symbol.lower()
    if lowered in FACTORS:
        return []
    if lowered in EVERYDAY and "/" not in EVERYDAY[lowered]:
        return [EVERYDAY[lowered]]
    found = [name for word, name in SPELLED_OUT.items() if word.lower() == lowered]
    found += [name for name, row in SYMBOLS.items() if row.meaning in (lowered, lowered[:-1])]
    other_case = [name for name in (*SYMBOLS, *ALIASES) if name.lower() == lowered]
    found += sorted(other_case, key=lambda name: sum(map(str.__ne__, name, symbol)))
    found += _split(symbol)
    return found or _close(lowered)


def _split(symbol: str) -> list[str]:
    """Two symbols that are written without a sign between them."""
    cuts = [(symbol[:cut], symbol[cut:]) for cut in range(1, len(symbol))]
    return [f"{left}*{right}" for left, right in cuts if left in SYMBOLS and right in SYMBOLS]


def _close(lowered: str) -> list[str]:
    """The symbols that differ by one typing error. Short symbols are left out, because every symbol
    would be similar.
    """
    import difflib  # takes 15 ms, which a file without mistakes need not spend

    if len(lowered) < 3:
        return []
    words = {name.lower(): name for name in (*SYMBOLS, *ALIASES)}
    words |= {row.meaning: name for name, row in SYMBOLS.items()} | dict(SPELLED_OUT)
    close = difflib.get_close_matches(lowered, words, n=2, cutoff=0.7)
    return list(dict.fromkeys(words[word] for word in close))
