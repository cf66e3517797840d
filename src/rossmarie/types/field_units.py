"""The units of the fields of common ROS messages; .msg files have no place for them.

The units come from the comments in the message definitions. Where these are silent, they come from
REP 103 (standard units: metre, kilogram, second, radian, SI). The unit of a vector field applies to
all components. For a field in a nested message, the unit of the outermost message takes precedence:
`geometry_msgs/Point` is in metres, but `visualization_msgs/ImageMarker.position` is not.

Units that the definition leaves open are missing, so that a rule has to give them (`in rad`). These
fields are the positions, velocities and efforts of joints (radians or metres, by the kind of
joint), covariances and variances of mixed or unstated units, axes of a joystick, pixels, counts and
codes. Times and durations are always in seconds and need no row.
"""

from __future__ import annotations

from collections.abc import Mapping

_POINT = {"x": "m", "y": "m", "z": "m"}
_SCAN = {
    "angle_min": "rad",
    "angle_max": "rad",
    "angle_increment": "rad",
    "time_increment": "s",
    "scan_time": "s",
    "range_min": "m",
    "range_max": "m",
}

FIELD_UNITS: Mapping[str, Mapping[str, str | None]] = {
    "bond/Status": {"heartbeat_timeout": "s", "heartbeat_period": "s"},
    "builtin_interfaces/Duration": {"sec": "s", "nanosec": "ns"},
    "builtin_interfaces/Time": {"sec": "s", "nanosec": "ns"},
    "geometry_msgs/Accel": {"linear": "m/s^2", "angular": "rad/s^2"},
    "geometry_msgs/Inertia": {
        "m": "kg",
        "com": "m",
        "ixx": "kg*m^2",
        "ixy": "kg*m^2",
        "ixz": "kg*m^2",
        "iyy": "kg*m^2",
        "iyz": "kg*m^2",
        "izz": "kg*m^2",
    },
    "geometry_msgs/Point": _POINT,
    "geometry_msgs/Point32": _POINT,
    "geometry_msgs/Pose": {"position": "m"},
    "geometry_msgs/Pose2D": {"x": "m", "y": "m", "theta": "rad"},
    "geometry_msgs/Quaternion": {"x": "1", "y": "1", "z": "1", "w": "1"},
    "geometry_msgs/Transform": {"translation": "m"},
    "geometry_msgs/Twist": {"linear": "m/s", "angular": "rad/s"},
    "geometry_msgs/Wrench": {"force": "N", "torque": "N*m"},
    "nav_msgs/GridCells": {"cell_width": "m", "cell_height": "m"},
    "nav_msgs/MapMetaData": {"resolution": "m"},  # per cell
    "sensor_msgs/BatteryState": {
        "voltage": "V",
        "temperature": "degC",
        "current": "A",
        "charge": "Ah",
        "capacity": "Ah",
        "design_capacity": "Ah",
        "percentage": "1",  # from 0 to 1, despite its name
        "cell_voltage": "V",
        "cell_temperature": "degC",
    },
    "sensor_msgs/FluidPressure": {"fluid_pressure": "Pa"},
    "sensor_msgs/Illuminance": {"illuminance": "lx"},
    "sensor_msgs/Imu": {"angular_velocity": "rad/s", "linear_acceleration": "m/s^2"},
    "sensor_msgs/LaserScan": {**_SCAN, "ranges": "m"},
    "sensor_msgs/MagneticField": {"magnetic_field": "T"},
    "sensor_msgs/MultiEchoLaserScan": _SCAN,
    "sensor_msgs/NavSatFix": {
        "latitude": "deg",
        "longitude": "deg",
        "altitude": "m",
        "position_covariance": "m^2",
    },
    "sensor_msgs/PointCloud2": {"points": "m"},
    "sensor_msgs/Range": {
        "field_of_view": "rad",
        "min_range": "m",
        "max_range": "m",
        "range": "m",
    },
    "sensor_msgs/RelativeHumidity": {"relative_humidity": "1"},  # from 0 to 1
    "sensor_msgs/Temperature": {"temperature": "degC"},
    "shape_msgs/SolidPrimitive": {"dimensions": "m"},
    "std_msgs/ColorRGBA": {"r": "1", "g": "1", "b": "1", "a": "1"},
    "stereo_msgs/DisparityImage": {"t": "m", "T": "m"},
    "visualization_msgs/ImageMarker": {"position": None},  # pixels
    "visualization_msgs/Marker": {"scale": "m"},
    "visualization_msgs/UVCoordinate": {"u": "1", "v": "1"},
}
"""Unit by message and field. None means that the unit is open, although a nested message has
one.
"""

RATIOS = frozenset(
    ("sensor_msgs/BatteryState.percentage", "sensor_msgs/RelativeHumidity.relative_humidity")
)
"""Fields that are documented as ratios from 0 to 1; numbers above 1 are not expected there."""
