"""The prefix of the public names of the generated C: the name of a rules file as an identifier.

The input is any text. The result is a word that is not reserved in C and C++, and that the
generated C does not use.
"""

from __future__ import annotations

import re
import unicodedata

from rossmarie.core import Function, Sampling

_LONGEST = 40

_LANGUAGE = """
    alignas alignof and and_eq asm atomic auto bitand bitor bool break case catch char class compl
    concept const consteval constexpr constinit const_cast continue co_await co_return co_yield
    decltype default delete do double dynamic_cast else enum explicit export extern false float for
    friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or
    or_eq private protected public register reinterpret_cast requires restrict return short signed
    sizeof static static_assert static_cast struct switch template this thread_local throw true try
    typedef typeid typename typeof union unsigned using virtual void volatile wchar_t while xor
    xor_eq linux unix
"""

# Names that the generated functions use in places where a field of a message is a parameter.
_GENERATED = """
    arcsine arcsine_far arcsine_surplus arctangent arctangent_surplus arrive arrived before begin
    both catch_up compute cross either element_proposition evaluate events every fabs first follow
    how_many i index_t is_calm is_inside is_pending isfinite isnan known leading m mark monitor
    opposite outcome sample sample_window seconds_between set_wake settle some sqrt t_ns tick visit
    window_middle
"""

# Prefixes, up to the first underscore, of the internal names of the generated C; a test collects
# them.
_PRIVATE = """
    above age always append arcsine arctangent are arithmetic array at before begins below by catch
    change channel claiming column command covered cross dbl drop due earliest edge element engages
    enough expire factor failed fails flag flt forget fp from gain gap give goes guard has held
    host how index input int16 int32 int64 is late latest leaf limit literal look lose stale most
    never no node now on opposite or others pass planned pose poses receive recent report resource
    rossmarie
    row rule sampled samples scale seconds set settle shown since size slot stage staged stamp
    start started swings t take task term text texts timeout proposition propositions topic truth
    turn
    uint16 uint64 uint8 unknown unknowns value values wake was watched width window x yields
"""

_RESERVED = frozenset((_LANGUAGE + _GENERATED).split())
_PRIVATE_WORDS = frozenset(_PRIVATE.split()) | {
    each.value.split("_")[0] for each in (*Function, *Sampling)
}
_FUNCTION = re.compile(r"[a-z]+_of(_\d+)?")
"""Names of functions of the core in C."""


def c_identifier(text: str) -> str:
    """The text as a word of letters, digits and underscores; never empty, never reserved."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode("ascii")
    word = re.sub(r"[^a-z0-9]+", "_", plain.lower()).strip("_")[:_LONGEST].strip("_")
    if not word or word[0].isdigit():
        word = f"n{word}"
    is_taken = word in _RESERVED or _FUNCTION.fullmatch(word)
    return f"{word}_" if is_taken else word


def public_prefix(program: str) -> str:
    """The prefix of all public names of a monitor: the name of its rules file. The prefix differs
    from the name if it would create a name that the monitor uses inside, such as `rule_values` for
    `rule.ross`.
    """
    word = c_identifier(program)
    return f"ross_{word}" if word.split("_")[0] in _PRIVATE_WORDS else word
