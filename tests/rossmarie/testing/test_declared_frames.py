"""Generated tests try thresholds with messages in the frame that the system model declares."""

from __future__ import annotations

from pathlib import Path

from rossmarie.driver.generating import generate_tests
from rossmarie.driver.testing import run_test_file

RULES = """\
system robot {
    frame hand in base_link timeout 0.2 sec;
    topic /force : geometry_msgs/WrenchStamped from hand;
}
action stop;
input force = topic /force .wrench.force timeout 0.2 sec;
rule pressed: if norm(force) > 5 N then { stop; };
"""


def test_a_threshold_is_tried_in_the_declared_frame(tmp_path: Path) -> None:
    path = tmp_path / "rules.ross"
    path.write_text(RULES, encoding="utf-8")
    found = generate_tests(path)
    found.path.write_text(found.text, encoding="utf-8")
    ran = run_test_file(path, in_c=False)
    assert set(ran.coverage.goals) - ran.coverage.reached == set()
