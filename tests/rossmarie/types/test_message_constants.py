"""The constants of message definitions, and the messages inside others."""

from __future__ import annotations

from pathlib import Path

from rossmarie.types import MessageCatalog


def test_constants_are_read_from_common_messages_and_from_files(tmp_path: Path) -> None:
    folder = tmp_path / "my_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Mode.msg").write_text(
        "uint8 OFF=0\nint8 LOW = -3 # low\nstring NAME=a = b\nbool YES=true\nfloat32 HALF=0.5\n"
        "my_msgs/Inner[] inner\nuint8 mode\n"
    )
    (folder / "Inner.msg").write_text("uint8 DEEP=7\nuint8 value\n")
    catalog = MessageCatalog((tmp_path,))
    assert catalog.constants("my_msgs/Mode") == {
        "OFF": 0.0, "LOW": -3.0, "NAME": "a = b", "YES": 1.0, "HALF": 0.5,
    }  # fmt: skip
    assert catalog.parts("my_msgs/msg/Mode") == ("my_msgs/Mode", "my_msgs/Inner")
    assert catalog.called("Inner") == ["my_msgs/Inner"]
    assert catalog.constants("actionlib_msgs/GoalStatus")["ABORTED"] == 4.0
    assert catalog.constants("no_msgs/None") == {}
