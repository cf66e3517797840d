import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rossmarie.types import (
    Array,
    Boolean,
    InterfaceKind,
    Leaf,
    Message,
    MessageCatalog,
    MessageDefinitionError,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unsupported,
    Vector,
    message_value,
    std_msgs_data,
)
from rossmarie.types.definitions import MessageDefinition, read_stored, stored_texts
from rossmarie.types.field_units import FIELD_UNITS, RATIOS
from rossmarie.types.snapshot import render
from rossmarie.units import DIMENSIONLESS, parse_unit

WHEEL = """\
# A wheel.
uint8 LEFT=0
Header header
float64 speed      # no unit here
bool[4] contacts
geometry_msgs/Point center
Axle axle
wstring label
"""
AXLE = "float32 torque\nMissing missing\nWheel[] wheels\nAxle again\n"


def quantity(unit: str) -> Quantity:
    return Quantity(parse_unit(unit))


def at(type_: Type | None, *path: str) -> Type:
    assert type_ is not None
    for name in path:
        assert isinstance(type_, Message)
        type_ = type_.fields[name]
    return type_


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / f"{name}.msg"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path, "my_msgs/msg/Wheel", WHEEL)
    write(tmp_path, "my_msgs/Axle", AXLE)
    return tmp_path


@pytest.mark.parametrize(
    ("message", "path", "expected"),
    [
        ("sensor_msgs/Imu", "orientation", Quaternion()),
        ("sensor_msgs/Imu", "angular_velocity", Vector(quantity("rad/s"))),
        ("sensor_msgs/Imu", "linear_acceleration", Vector(quantity("m/s^2"))),
        ("sensor_msgs/Imu", "orientation_covariance", Array(Quantity(None))),
        ("sensor_msgs/Imu", "header.stamp", quantity("s")),
        ("sensor_msgs/Imu", "header.frame_id", Text()),
        ("sensor_msgs/Imu", "header.seq", Quantity(None)),
        ("geometry_msgs/Wrench", "torque", Vector(quantity("N*m"))),
        ("nav_msgs/Odometry", "pose.pose.position", Vector(quantity("m"))),
        ("nav_msgs/Odometry", "twist.twist.angular", Vector(quantity("rad/s"))),
        ("nav_msgs/OccupancyGrid", "info.resolution", quantity("m")),
        ("geometry_msgs/AccelStamped", "accel.linear", Vector(quantity("m/s^2"))),
        ("geometry_msgs/Vector3Stamped", "vector", Vector(Quantity(None))),
        ("geometry_msgs/Point", "x", quantity("m")),
        ("visualization_msgs/ImageMarker", "position", Vector(Quantity(None))),
        ("sensor_msgs/LaserScan", "ranges", Array(quantity("m"))),
        ("sensor_msgs/JointState", "position", Array(Quantity(None))),
        ("sensor_msgs/NavSatFix", "latitude", quantity("deg")),
        ("sensor_msgs/NavSatFix", "status.status", Quantity(None)),
        ("sensor_msgs/BatteryState", "percentage", Quantity(DIMENSIONLESS)),
        ("sensor_msgs/BatteryState", "present", Boolean()),
        ("trajectory_msgs/JointTrajectoryPoint", "time_from_start", quantity("s")),
        ("std_msgs/Time", "data", quantity("s")),
        ("std_msgs/Byte", "data", Quantity(None)),
    ],
)
def test_fields_of_common_messages(message: str, path: str, expected: Type) -> None:
    assert at(MessageCatalog().find(message), *path.split(".")) == expected


def test_both_spellings_are_one_message() -> None:
    catalog = MessageCatalog()
    assert catalog.find("sensor_msgs/msg/Imu") is catalog.find("sensor_msgs/Imu")
    found = catalog.find("sensor_msgs/msg/Imu")
    assert found is not None
    assert found.name == "sensor_msgs/Imu"


@pytest.mark.parametrize(
    "name", ["sensor_msgs/Imo", "Imu", "", "a/b/c/d", "../../etc/passwd", "a/../b", "/Imu", "a/b\n"]
)
def test_other_names_are_not_found(name: str, folder: Path) -> None:
    assert MessageCatalog([folder]).find(name) is None


def test_arrays_of_strings_and_times_say_why_they_cannot_be_used(folder: Path) -> None:
    write(folder, "my_msgs/Times", "time[] stamps")
    names = at(MessageCatalog().find("sensor_msgs/JointState"), "name")
    stamps = at(MessageCatalog([folder]).find("my_msgs/Times"), "stamps")
    assert isinstance(names, Unsupported)
    assert "array of strings" in names.reason
    assert isinstance(stamps, Unsupported)
    assert "array of times" in stamps.reason


def test_every_stored_message_resolves() -> None:
    catalog = MessageCatalog()
    for name in catalog.known_names():
        message = catalog.find(name)
        assert message is not None
        assert not any(
            isinstance(field, Unsupported) and "definition" in field.reason
            for field in message.fields.values()
        )


def test_definitions_from_folders(folder: Path) -> None:
    wheel = MessageCatalog([folder]).find("my_msgs/Wheel")
    assert wheel is not None
    assert list(wheel.fields) == ["header", "speed", "contacts", "center", "axle", "label"]
    assert at(wheel, "header", "stamp") == quantity("s")
    assert at(wheel, "speed") == Quantity(None)
    assert at(wheel, "contacts") == Array(Boolean())
    assert at(wheel, "center") == Vector(quantity("m"))
    assert at(wheel, "label") == Text()
    assert at(wheel, "axle", "torque") == Quantity(None)


@pytest.mark.parametrize(
    ("field", "reason"),
    [("missing", "my_msgs/Missing"), ("wheels", "inside itself"), ("again", "inside itself")],
)
def test_fields_from_folders_that_cannot_be_used(folder: Path, field: str, reason: str) -> None:
    found = at(MessageCatalog([folder]).find("my_msgs/Wheel"), "axle", field)
    assert isinstance(found, Unsupported)
    assert reason in found.reason


def test_folders_come_first_and_are_listed(folder: Path) -> None:
    write(folder, "sensor_msgs/msg/Imu", "float32 tilt")
    catalog = MessageCatalog([folder])
    assert list(at(catalog.find("sensor_msgs/Imu")).fields) == ["tilt"]  # type: ignore[union-attr]
    assert {"my_msgs/Wheel", "my_msgs/Axle", "nav_msgs/Odometry"} <= set(catalog.known_names())
    assert list(catalog.known_names()) == sorted(set(catalog.known_names()))


def test_overrides_beat_the_table_and_the_outermost_wins(folder: Path) -> None:
    overrides = {
        ("my_msgs/msg/Wheel", ("speed",)): parse_unit("rpm"),
        ("my_msgs/Wheel", ("center",)): parse_unit("mm"),
        ("geometry_msgs/Twist", ("linear",)): parse_unit("km/h"),
        ("nav_msgs/Odometry", ("twist", "twist", "linear")): parse_unit("cm/s"),
        ("sensor_msgs/MagneticField", ("magnetic_field", "x")): parse_unit("uT"),
    }
    catalog = MessageCatalog([folder], overrides)
    wheel = catalog.find("my_msgs/Wheel")
    assert at(wheel, "speed") == quantity("rpm")
    assert at(wheel, "center") == Vector(quantity("mm"))
    odometry = catalog.find("nav_msgs/Odometry")
    assert at(odometry, "twist", "twist", "linear") == Vector(quantity("cm/s"))
    assert at(odometry, "twist", "twist", "angular") == Vector(quantity("rad/s"))
    stamped = catalog.find("geometry_msgs/TwistStamped")
    assert at(stamped, "twist", "linear") == Vector(quantity("km/h"))
    magnetic = catalog.find("sensor_msgs/MagneticField")
    assert at(magnetic, "magnetic_field") == Vector(quantity("uT"))


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("float32 x\nfloat32[ y\n", 2, "float32[ y"),
        ("float32\n", 1, "float32"),
        ("int8 A=[1,2]\n", 1, "int8 A"),
        ("float32 x\n\n# c\nint8 x\n", 4, "second field named 'x'"),
        ("float32 x\n" + "=" * 80 + "\nMSG: a/B\n", 2, "===="),
        ("int8 A=" + "9" * 5000, 1, "int8 A"),
        ("# " + "x" * 70_000, None, "larger than 64 KiB"),
    ],
)
def test_malformed_files_are_located(
    tmp_path: Path, text: str, line: int | None, reason: str
) -> None:
    path = write(tmp_path, "my_msgs/Bad", text)
    write(tmp_path, "my_msgs/Outer", "Bad bad")
    for name in ("my_msgs/Bad", "my_msgs/Outer"):
        with pytest.raises(MessageDefinitionError) as caught:
            MessageCatalog([tmp_path]).find(name)
        assert (caught.value.path, caught.value.line) == (path, line)
        assert reason in caught.value.reason


def test_binary_files_are_refused(tmp_path: Path) -> None:
    path = write(tmp_path, "my_msgs/Bad", "")
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(MessageDefinitionError, match="not UTF-8"):
        MessageCatalog([tmp_path]).find("my_msgs/Bad")


def test_windows_line_ends_and_byte_order_marks_are_fine(tmp_path: Path) -> None:
    path = write(tmp_path, "my_msgs/Ok", "")
    path.write_bytes("\ufefffloat32 x\r\nint8 y # z\r\n".encode())
    assert list(at(MessageCatalog([tmp_path]).find("my_msgs/Ok")).fields) == ["x", "y"]  # type: ignore[union-attr]


def test_messages_that_unfold_without_bound_are_refused(tmp_path: Path) -> None:
    for level in range(30):
        write(tmp_path, f"my_msgs/L{level}", f"L{level + 1} a\nL{level + 1} b\n")
    write(tmp_path, "my_msgs/L30", "int8 x")
    with pytest.raises(MessageDefinitionError, match="more than 20000 fields"):
        MessageCatalog([tmp_path]).find("my_msgs/L0")


def test_long_chains_of_messages_end(tmp_path: Path) -> None:
    for level in range(500):
        write(tmp_path, f"my_msgs/L{level}", f"L{level + 1} a\n")
    type_ = at(MessageCatalog([tmp_path]).find("my_msgs/L0"))
    while isinstance(type_, Message):
        type_ = type_.fields["a"]
    assert isinstance(type_, Unsupported)


@given(st.text(alphabet="int8float32 string[]<=x=#\"'/\n\t.@", max_size=60))
def test_any_text_is_a_definition_or_located(
    tmp_path_factory: pytest.TempPathFactory, text: str
) -> None:
    folder = tmp_path_factory.mktemp("msg")
    write(folder, "my_msgs/Any", text)
    line = None
    try:
        found = MessageCatalog([folder]).find("my_msgs/Any") is not None
    except MessageDefinitionError as error:
        line = error.line
        found = False
    assert found or line is not None


def test_whole_messages_as_values() -> None:
    catalog = MessageCatalog()
    values = {
        name: message_value(found)
        for name in ("geometry_msgs/Point", "geometry_msgs/Quaternion", "sensor_msgs/Imu")
        if (found := catalog.find(name)) is not None
    }
    assert values["geometry_msgs/Point"] == Vector(quantity("m"))
    assert values["geometry_msgs/Quaternion"] == Quaternion()
    assert values["sensor_msgs/Imu"] == catalog.find("sensor_msgs/Imu")


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("std_msgs/Float32", Quantity(None)),
        ("std_msgs/Bool", Boolean()),
        ("std_msgs/String", Text()),
        ("std_msgs/Header", None),
        ("std_msgs/Float32MultiArray", None),
        ("sensor_msgs/Imu", None),
    ],
)
def test_data_of_std_msgs(name: str, data: Type | None) -> None:
    message = MessageCatalog().find(name)
    assert message is not None
    assert std_msgs_data(message) == data
    assert std_msgs_data(Boolean()) is None


def test_every_field_that_the_table_names_exists_and_is_numeric() -> None:
    catalog = MessageCatalog()
    for name, fields in FIELD_UNITS.items():
        for field, symbol in fields.items():
            unit = None if symbol is None else parse_unit(symbol)
            type_ = at(catalog.find(name), *field.split("."))
            element = type_ if isinstance(type_, Quantity) else getattr(type_, "element", None)
            number = element.element if isinstance(element, Vector) else element
            assert number == Quantity(unit), (name, field)


def test_stored_definitions_are_those_of_rosbags() -> None:
    rendered = render()
    assert rendered == "".join(
        f"{'=' * 80}\nMSG: {name}\n{text}" for name, text in stored_texts().items()
    ), "run: python -m rossmarie.types.snapshot"


def test_stored_definitions_prefer_ros_2_and_add_what_only_ros_1_has() -> None:
    camera = read_stored("sensor_msgs/CameraInfo")
    assert camera is not None
    assert {"k", "K"} <= set(camera.fields)
    assert read_stored("rosgraph_msgs/Log") is not None
    assert read_stored("std_msgs/Empty") == MessageDefinition({}, {})


def test_common_messages_need_neither_rosbags_nor_numpy() -> None:
    program = (
        "import sys; from rossmarie.types import MessageCatalog;"
        "assert MessageCatalog().find('nav_msgs/Odometry');"
        "assert not {'rosbags', 'numpy', 'pint', 'difflib'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_ratios_are_plain_numbers() -> None:
    catalog = MessageCatalog()
    for ratio in RATIOS:
        name, field = ratio.split(".")
        assert at(catalog.find(name), field) == Quantity(DIMENSIONLESS)


def test_the_folder_of_a_package_is_not_taken_for_the_folder_of_all(folder: Path) -> None:
    catalog = MessageCatalog([folder / "my_msgs"])
    assert catalog.find("my_msgs/Wheel") is None
    assert "my_msgs/Wheel" not in catalog.known_names()
    assert catalog.package_of("my_msgs/msg/Wheel") == folder / "my_msgs"
    assert MessageCatalog([folder]).package_of("my_msgs/Wheel") is None


def test_the_common_services_are_known() -> None:
    catalog = MessageCatalog()
    assert catalog.known_names(InterfaceKind.SERVICE) == [
        "std_srvs/Empty",
        "std_srvs/SetBool",
        "std_srvs/Trigger",
    ]
    assert at(catalog.find_sent("std_srvs/srv/SetBool", InterfaceKind.SERVICE), "data") == Boolean()
    assert catalog.find("std_srvs/SetBool") is None
    assert catalog.find_sent("std_srvs/SetBol", InterfaceKind.SERVICE) is None


def test_requests_and_goals_end_at_the_first_dashes(tmp_path: Path) -> None:
    for kind in ("srv", "action"):
        path = tmp_path / "my_msgs" / kind / f"Grip.{kind}"
        path.parent.mkdir(parents=True)
        path.write_text(
            "float64 force\ngeometry_msgs/Point at\n---\nbool success\n---\nint8 done\n"
        )
    catalog = MessageCatalog([tmp_path])
    for sent in (InterfaceKind.SERVICE, InterfaceKind.ACTION):
        found = catalog.find_sent("my_msgs/Grip", sent)
        assert found is not None
        assert list(found.fields) == ["force", "at"]
        assert list(catalog.leaves(found))[-1] == Leaf(("at", "z"), "float64", False)
        assert "my_msgs/Grip" in catalog.known_names(sent)


def test_common_actions_are_known_without_a_file() -> None:
    catalog = MessageCatalog()
    arm = catalog.find_sent("control_msgs/action/FollowJointTrajectory", InterfaceKind.ACTION)
    assert at(arm, "goal_time_tolerance") == quantity("s")
    assert isinstance(at(arm, "path_tolerance"), Unsupported)
    base = catalog.find_sent("nav2_msgs/NavigateToPose", InterfaceKind.ACTION)
    assert at(base, "pose", "pose", "position") == Vector(quantity("m"))
    assert catalog.find_sent("nav2_msgs/NavigateToPose", InterfaceKind.SERVICE) is None


def test_goals_of_ros_1_are_messages() -> None:
    goal = MessageCatalog().find_sent("actionlib/TwoInts", InterfaceKind.ACTION)
    assert goal is not None
    assert list(goal.fields) == ["a", "b"]


def test_messages_have_no_dashes(tmp_path: Path) -> None:
    write(tmp_path, "my_msgs/Grip", "float64 force\n---\n")
    with pytest.raises(MessageDefinitionError, match="not a field"):
        MessageCatalog([tmp_path]).find("my_msgs/Grip")


def test_leaves_leave_out_arrays_of_messages_and_messages_in_themselves(tmp_path: Path) -> None:
    write(tmp_path, "my_msgs/Knot", "Knot left\nKnot right\nfloat32[] values\nKnot[] more\n")
    catalog = MessageCatalog([tmp_path])
    knot = catalog.find("my_msgs/Knot")
    assert knot is not None
    assert list(catalog.leaves(knot)) == [Leaf(("values",), "float32", True)]
