"""Lists of messages: a rule looks at the fields of one element after the other, up to a bound."""

from __future__ import annotations

from collections.abc import Callable

from support.live import Process, Robot, until

Start = Callable[..., Process]

FINE, BROKEN, OTHER = ("motor", "OK"), ("motor", "ERROR"), ("camera", "ERROR")


def test_an_element_is_found_wherever_it_stands(robot: Robot, start: Start) -> None:
    start()

    def becomes(is_active: bool, parts: list[tuple[str, str]]) -> None:
        robot.set(parts=parts)
        until(lambda: ("failing" in robot.state().get("active", ())) == is_active, f"{parts}")

    becomes(True, [OTHER, BROKEN])
    becomes(False, [FINE, OTHER])
    becomes(True, [BROKEN, FINE, OTHER])
    becomes(False, [])
    # Of a list that is too long nothing is known; the rule stays as it is until the next message.
    becomes(False, [FINE, OTHER, OTHER, BROKEN])
    becomes(True, [OTHER, OTHER, BROKEN])
    becomes(True, [FINE, OTHER, OTHER, OTHER])
    becomes(False, [FINE])
