"""The robot: its controllers, which execute commands, and its sensors, which measure the
physics.
"""

from heron.robot.arm import Arm
from heron.robot.arm_controller import ArmController, ArmControllerParameters
from heron.robot.base import Base
from heron.robot.drive import DifferentialDrive, DriveParameters
from heron.robot.force_torque import ForceTorque, ForceTorqueParameters
from heron.robot.imu import Imu, ImuParameters
from heron.robot.joint_states import JointStates, JointStatesParameters
from heron.robot.localization import Localization, LocalizationParameters
from heron.robot.odometry import WheelOdometry, WheelOdometryParameters
from heron.robot.range_scan import RangeScan, RangeScanParameters

__all__ = [
    "Arm",
    "ArmController",
    "ArmControllerParameters",
    "Base",
    "DifferentialDrive",
    "DriveParameters",
    "ForceTorque",
    "ForceTorqueParameters",
    "Imu",
    "ImuParameters",
    "JointStates",
    "JointStatesParameters",
    "Localization",
    "LocalizationParameters",
    "RangeScan",
    "RangeScanParameters",
    "WheelOdometry",
    "WheelOdometryParameters",
]
