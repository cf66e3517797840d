"""CSV files as recordings."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from rossmarie.ir import Array, FieldKind
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.opening import open_recording
from support.recordings import BATTERY, codes, machine, replay, slot, volts

POSE = machine(
    [("/imu", "sensor_msgs/Imu"), ("/battery", "std_msgs/Float32")],
    [("speed", 0), ("battery", 1)],
    [slot(0, "orientation", "x"), slot(0, "orientation", "y"), slot(1, "data")],
)


def write(folder: Path, text: str) -> Path:
    path = folder / "drive.csv"
    path.write_text(text, encoding="utf-8")
    return path


def instants(folder: Path, text: str) -> list[int]:
    updates, _ = replay(write(folder, text))
    return [update.at_ns for update in updates]


@pytest.mark.parametrize("name", ["time", "t", "stamp", "Time"])
def test_time_in_seconds(tmp_path: Path, name: str) -> None:
    text = f"{name},battery\n0,1\n0.25,1\n1e1,1\n1432235498.025043042,1\n"
    found = [0, 250_000_000, 10_000_000_000, 1_432_235_498_025_043_042]
    assert instants(tmp_path, text) == found


def test_time_in_nanoseconds_by_name(tmp_path: Path) -> None:
    assert instants(tmp_path, "time_ns,battery\n5,1\n7,1\n") == [5, 7]


def test_time_in_nanoseconds_by_size(tmp_path: Path) -> None:
    text = "time,battery\n1432235498025043042,1\n1432235498025043043,1\n"
    assert instants(tmp_path, text) == [1_432_235_498_025_043_042, 1_432_235_498_025_043_043]


@pytest.mark.parametrize("column", ["/battery.data", "/battery", "battery", "battery.data"])
def test_names_of_a_column(tmp_path: Path, column: str) -> None:
    updates, found = replay(write(tmp_path, f"time,{column}\n0,12.5\n"))
    assert found == ()
    assert volts(updates) == [12.5]


@pytest.mark.parametrize("names", ["/imu.orientation.x,/imu.orientation.y", "speed.x,speed.y"])
def test_names_of_parts(tmp_path: Path, names: str) -> None:
    updates, found = replay(write(tmp_path, f"time,{names},battery\n0,1,2,3\n"), POSE)
    assert found == ()
    assert updates[0].channels[0].slots == {0: 1.0, 1: 2.0}


def test_input_name_alone_must_be_plain(tmp_path: Path) -> None:
    """`speed` has two parts: which one a column `speed` would hold is not clear."""
    _, found = replay(write(tmp_path, "time,speed,battery\n0,1,2\n"), POSE)
    assert codes(found) == ["ROSS623"]
    assert found[0].help == "did you mean `speed`? then name this column `speed.x`"


def test_one_row_is_one_instant(tmp_path: Path) -> None:
    updates, _ = replay(write(tmp_path, "time,speed.x,speed.y,battery\n0,1,2,3\n"), POSE)
    assert len(updates) == 1
    assert set(updates[0].channels) == {0, 1}


def test_blank_cells(tmp_path: Path) -> None:
    text = "time,speed.x,speed.y,battery\n0,1,,3\n1, ,,4\n2,,,\n3,5,6,\n"
    updates, found = replay(write(tmp_path, text), POSE)
    assert found == ()
    assert [(update.at_ns, set(update.channels)) for update in updates] == [
        (0, {0, 1}),
        (1_000_000_000, {1}),
        (3_000_000_000, {0}),
    ]
    assert math.isnan(updates[0].channels[0].slots[1])


def test_rows_keep_the_order_of_the_file(tmp_path: Path) -> None:
    assert instants(tmp_path, "time_ns,battery\n5,1\n3,1\n4,1\n") == [5, 3, 4]


def test_flags_and_texts(tmp_path: Path) -> None:
    rules = machine(
        [("/blocked", "std_msgs/Bool"), ("/mode", "std_msgs/String")],
        [("blocked", 0), ("mode", 1)],
        [slot(0, "data", kind=FieldKind.FLAG), slot(1, "data", kind=FieldKind.TEXT)],
        texts=["docked", "driving"],
    )
    text = "time,blocked,mode\n0,true,driving\n1,False,docked\n2,1,stale\n3,0,docked\n"
    updates, found = replay(write(tmp_path, text), rules)
    assert found == ()
    assert [update.channels[0].slots[0] for update in updates] == [1.0, 0.0, 1.0, 0.0]
    assert [update.channels[1].slots[1] for update in updates] == [1.0, 0.0, -1.0, 0.0]


@pytest.mark.parametrize(
    "names", ["/scan.ranges[0],/scan.ranges[1],/scan.ranges[2]", "scan.0,scan.1,scan.2"]
)
def test_arrays_are_columns_with_an_index(tmp_path: Path, names: str) -> None:
    rules = machine(
        [("/scan", "sensor_msgs/LaserScan")],
        [("scan", 0)],
        arrays=[Array(0, ("ranges",), 1.0, 0.0, "m")],
    )
    updates, found = replay(write(tmp_path, f"time,{names}\n0,1,2,3\n1,4,inf,\n"), rules)
    assert found == ()
    assert [update.channels[0].arrays[0] for update in updates] == [[1, 2, 3], [4, math.inf]]


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_delimiters(tmp_path: Path, delimiter: str) -> None:
    rows = [["time", "other", "battery"], ["0", "9", "12.5"]]
    path = write(tmp_path, "\r\n".join(delimiter.join(row) for row in rows))
    assert volts(replay(path)[0]) == [12.5]


def test_byte_order_mark(tmp_path: Path) -> None:
    assert instants(tmp_path, "\ufefftime_ns,battery\n5,1\n") == [5]


def test_topics_and_span(tmp_path: Path) -> None:
    path = write(tmp_path, "time_ns,/a.x,/a.y,/b,c\n7,1,,,1\n3,,2,,1\n9,,,,1\n")
    with open_recording(path) as recording:
        assert (recording.start_ns, recording.end_ns) == (7, 9)  # in the order of the file
        found = [(t.name, t.message_type, t.count) for t in recording.topics.values()]
        assert found == [("/a", None, 2), ("/b", None, 0)]


def test_topic_map(tmp_path: Path) -> None:
    updates, _ = replay(write(tmp_path, "time,/power.data\n0,3\n"), BATTERY, {"/battery": "/power"})
    assert volts(updates) == [3.0]


# --- trouble ---------------------------------------------------------------------------------


def test_cells_that_are_no_numbers(tmp_path: Path) -> None:
    updates, found = replay(write(tmp_path, "time,battery\n0,1\n1,low\n2,2\n3,?\n"))
    assert codes(found) == ["ROSS605"]
    assert "2 of 4 values" in found[0].title
    assert found[0].title.endswith("values in the column `battery` cannot be read")
    assert "1.000 s into the recording: `low` in the column" in found[0].notes[0]
    assert "type definitions" not in (found[0].help or "")
    assert math.isnan(volts(updates)[1])
    assert len(updates) == 4


@pytest.mark.parametrize(
    "row", ["soon,1", ",1", "1", "1,2,3", "1e99,1", "nan,1", "9e999999,1", "1_0,1"]
)
def test_rows_that_do_not_fit(tmp_path: Path, row: str) -> None:
    updates, found = replay(write(tmp_path, f"time,battery\n0,1\n{row}\n2,2\n{row}\n"))
    assert codes(found) == ["ROSS621"]
    assert found[0].title == "2 of 4 rows are skipped"
    assert "row 3" in found[0].primary.text
    assert volts(updates) == [1.0, 2.0]


def test_field_without_a_column(tmp_path: Path) -> None:
    updates, found = replay(write(tmp_path, "time,speed.x,battery\n0,1,2\n"), POSE)
    assert codes(found) == ["ROSS604"]
    assert "orientation.y" in found[0].title
    assert updates[0].channels[0].slots == pytest.approx({0: 1.0, 1: math.nan}, nan_ok=True)


def test_column_that_is_never_filled(tmp_path: Path) -> None:
    _, found = replay(write(tmp_path, "time,speed.x,speed.y,battery\n0,,,2\n"), POSE)
    assert codes(found) == ["ROSS603"]


BEAT = machine(
    [("/beat", "std_msgs/Empty"), ("/battery", "std_msgs/Float32")],
    [("speed", 0), ("battery", 1)],
    [slot(1, "data")],
)


@pytest.mark.parametrize("column", ["/beat", "speed"])
def test_a_column_says_that_a_message_of_which_only_the_age_is_read_came(
    tmp_path: Path, column: str
) -> None:
    updates, found = replay(write(tmp_path, f"time,{column},battery\n0,1,\n1,,2\n2,x,3\n"), BEAT)
    assert found == ()
    assert [set(update.channels) for update in updates] == [{0}, {1}, {0, 1}]


def test_a_message_of_which_only_the_age_is_read_needs_a_column(tmp_path: Path) -> None:
    updates, found = replay(write(tmp_path, "time,battery\n0,1\n"), BEAT)
    assert codes(found) == ["ROSS623"]
    assert "speed" in found[0].title
    assert [set(update.channels) for update in updates] == [{1}]


def test_a_column_says_that_a_message_came_of_which_no_field_is_known(tmp_path: Path) -> None:
    text = "time,/imu,speed.x,speed.y,battery\n0,1,,,2\n1,,,,2\n"
    updates, found = replay(write(tmp_path, text), POSE)
    assert codes(found) == []
    assert [set(update.channels) for update in updates] == [{0, 1}, {1}]
    assert all(math.isnan(number) for number in updates[0].channels[0].slots.values())


def test_nothing_that_the_rules_read(tmp_path: Path) -> None:
    with pytest.raises(RecordingError) as caught:
        replay(write(tmp_path, "time,/other.x\n0,1\n"))
    found = caught.value.diagnostic
    assert found.code == "ROSS616"
    assert found.notes[0] == (
        "the rules read the inputs `battery`; the recording holds the columns `/other.x`"
    )
    assert "--topic-map" not in (found.help or "")


@pytest.mark.parametrize("text", ["battery,time\n1,0\n", "1,2\n", "\n", "\0\1\2,\n1,2\n"])
def test_first_column_is_not_the_time(tmp_path: Path, text: str) -> None:
    with pytest.raises(RecordingError) as caught:
        open_recording(write(tmp_path, text))
    assert caught.value.diagnostic.code == "ROSS620"


@pytest.mark.parametrize("text", ["time,battery\n", "time,battery", "time,battery\nx,1\n"])
def test_no_rows(tmp_path: Path, text: str) -> None:
    with pytest.raises(RecordingError) as caught:
        open_recording(write(tmp_path, text))
    assert caught.value.diagnostic.code == "ROSS613"


def test_binary_rubbish_behind_a_header(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    path.write_bytes(b"time,battery\n0,1\n" + bytes(range(256)) * 50 + b'\n1,2\n"')
    updates, found = replay(path)
    assert "ROSS621" in codes(found)
    assert volts(updates)[0] == 1.0


def test_numbers_are_not_written_as_in_python(tmp_path: Path) -> None:
    updates, found = replay(write(tmp_path, "time,battery\n0,1_0\n1,2e1\n"))
    assert codes(found) == ["ROSS605"]
    assert math.isnan(volts(updates)[0])
    assert volts(updates)[1] == 20.0


@pytest.mark.parametrize("cell", ["yes", "2", "0.5"])
def test_a_cell_that_is_no_flag(tmp_path: Path, cell: str) -> None:
    rules = machine(
        [("/blocked", "std_msgs/Bool")], [("blocked", 0)], [slot(0, "data", kind=FieldKind.FLAG)]
    )
    updates, found = replay(write(tmp_path, f"time,blocked\n0,{cell}\n1,TRUE\n2,1.0\n"), rules)
    assert codes(found) == ["ROSS605"]
    assert "is not `true`, `false`, `1` or `0`" in found[0].notes[0]
    assert math.isnan(volts(updates)[0])
    assert volts(updates)[1:] == [1.0, 1.0]


@pytest.mark.parametrize("header", ["time,battery,battery", "time,/scan.x[0],b,/scan.x.0"])
def test_a_column_that_is_there_twice(tmp_path: Path, header: str) -> None:
    with pytest.raises(RecordingError) as caught:
        open_recording(write(tmp_path, f"{header}\n0,1,2,3\n"))
    found = caught.value.diagnostic
    assert found.code == "ROSS622"
    assert found.primary.span.text == header.rpartition(",")[2]
    assert found.primary.span.start == header.rindex(",") + 1


def test_columns_without_a_name_are_not_repeated(tmp_path: Path) -> None:
    assert replay(write(tmp_path, "time,,,battery\n0,1,2,3\n"))[1] == ()


@pytest.mark.parametrize("column", ["Battery", "batery", "/Battery.data"])
def test_a_column_with_nearly_the_right_name(tmp_path: Path, column: str) -> None:
    path = write(tmp_path, f"time,speed.x,speed.y,{column}\n0,1,2,3\n")
    _, found = replay(path, POSE)
    assert codes(found) == ["ROSS623"]
    assert found[0].primary.span.text == "input battery"
    assert found[0].notes == (f"columns that no input reads: `{column}`",)
    assert found[0].help == f"did you mean `{column}`? then name this column `battery`"


def test_the_part_that_is_nearly_right_is_named(tmp_path: Path) -> None:
    _, found = replay(write(tmp_path, "time,battery,sped.y\n0,1,2\n"), POSE)
    assert found[0].help == "did you mean `sped.y`? then name this column `speed.y`"
    _, found = replay(write(tmp_path, "time,battery,other\n0,1,2\n"), POSE)
    assert found[0].help == "add `speed.x` and `speed.y`, or rename the column that holds it"


def test_columns_that_nobody_reads_do_no_harm(tmp_path: Path) -> None:
    assert replay(write(tmp_path, "time,battery,other\n0,1,2\n"))[1] == ()


def test_a_quotation_mark_that_is_not_closed(tmp_path: Path) -> None:
    path = write(tmp_path, 'time,battery\n0,"1\n' + "1,2\n" * 50_000)
    with pytest.raises(RecordingError) as caught:
        open_recording(path)
    assert caught.value.diagnostic.code == "ROSS614"
    assert "quotation mark" in caught.value.diagnostic.title
