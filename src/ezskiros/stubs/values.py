"""The type of a data property in a stub: the values with which it may be compared."""

from __future__ import annotations

import json
import re

from ezskiros.check.values import is_value_of, spelled_types
from ezskiros.ontology.model import Model

_SAMPLES = {"_int": 1, "_float": 0.5, "_str": "text", "_bool": True}
"""A sample of each type of compared values."""

_CALLED = {
    ("_int",): "_Whole",
    ("_float",): "_Number",
    ("_str",): "_Text",
    ("_bool",): "_Truth",
    ("_float", "_str", "_bool"): "_Anything",
}


def value_type(model: Model, iri: str) -> str:
    """The type of compared values, as in `check`. Only numbers have an order."""
    listed = model.values[iri].values
    if listed and not any(_is_fraction(each) for each in listed):
        return _listed_type(sorted(listed))
    types = [name for name, sample in _SAMPLES.items() if _is_allowed(model, iri, sample)]
    if "_float" in types:
        types.remove("_int")  # type checkers accept these as floats as well
    if tuple(types) in _CALLED:
        return _CALLED[tuple(types)]
    numbers = [name for name in types if name in ("_int", "_float")]
    both = " | ".join(types) or "_Nothing"
    return f"_Ordered[{both}, {numbers[0]}]" if numbers else f"_Value[{both}]"


def _is_allowed(model: Model, iri: str, sample: object) -> bool:
    """Say whether a value is in all known ranges of a property."""
    ranges = filter(None, map(spelled_types, model.range(iri)))
    return all(is_value_of(sample, names) for names in ranges)


def _listed_type(values: list[str]) -> str:
    """The type of the listed texts. The ontology lists numbers as texts, too."""
    wholes = [each for each in values if _WHOLE.fullmatch(each)]
    texts = [json.dumps(each, ensure_ascii=False) for each in values]
    literal = f"_Literal[{', '.join([*wholes, *texts])}]"
    return f"_Ordered[{literal}, _Literal[{', '.join(wholes)}]]" if wholes else f"_Value[{literal}]"


def _is_fraction(text: str) -> bool:
    """Say whether a text is a number that cannot be a literal type."""
    try:
        float(text)
    except ValueError:
        return False
    return _WHOLE.fullmatch(text) is None


_WHOLE = re.compile(r"0|-?[1-9][0-9]*")
