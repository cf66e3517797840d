"""Rules that do one and the same with what they need are in no conflict, whatever their actions."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.analysis.queries import ask_all
from rossmarie.driver import compile_file

RULES = """\
action halt {{ publish /arm/stop : std_msgs/Bool {{ data = true; }} at 10 Hz; }}
action hold {{ publish /arm/stop : std_msgs/Bool {{ data = {data}; }} at 10 Hz; }}
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
rule fast: if speed > 1 m/s then {{ halt; }};
rule racing: if speed > 2 m/s then {{ hold; }};
"""


@pytest.mark.parametrize(("data", "codes"), [("true", []), ("false", ["ROSS700"])])
def test_the_same_message_is_no_conflict(data: str, codes: list[str], tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES.format(data=data), encoding="utf-8")
    found = ask_all(compile_file(path).machine, thorough=False, within_ns=10**9)
    assert [each.diagnostic.code for each in found] == codes
