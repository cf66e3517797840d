"""Rules with scopes and exemptions do what S59 to S62 say, whatever a robot tells and however late
it does.
"""

from __future__ import annotations

from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st

from support.depth import examples
from support.exempted import differences, random_events, random_program


@settings(max_examples=examples(4))
@given(st.integers(0, 2**64))
def test_rules_hold_as_the_semantics_say(seed: int) -> None:
    random = Random(seed)
    program = random_program(random)
    assert list(differences(program, random_events(random))) == []
