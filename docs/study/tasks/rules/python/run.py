"""Runs the rules over a trace: `python run.py trace.csv`. Do not change this file."""

from __future__ import annotations

import csv
import sys

from messages import Imu, Odometry, Quaternion, Range, Twist, TwistWithCovariance, Vector3
from rover import Guard



def main() -> None:
    guard = Guard()
    with open(sys.argv[1], newline="") as opened:
        for row in csv.DictReader(opened):
            now = float(row["time"])
            if row["/imu/data.orientation.x"]:
                turned = [float(row[f"/imu/data.orientation.{axis}"]) for axis in "xyzw"]
                guard.on_imu(now, Imu(Quaternion(*turned)))
            if speed := row["/odom.twist.twist.linear.x"]:
                twist = TwistWithCovariance(Twist(Vector3(float(speed))))
                guard.on_odometry(now, Odometry(twist))
            if distance := row["/front.range"]:
                guard.on_front(now, Range(float(distance)))
            print(f"{now:.1f} {guard.command(now, float(row['wanted'])):.2f}")


main()
