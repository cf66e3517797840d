// The messages of the rover, as ROS has them. Do not change this file.
#pragma once
#include <algorithm>
#include <cmath>

struct Quaternion {
    double x, y, z, w;

    // Rotation about the x axis in rad.
    double roll() const { return std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)); }

    // Rotation about the y axis in rad.
    double pitch() const { return std::asin(std::max(-1.0, std::min(1.0, 2 * (w * y - z * x)))); }
};

struct Imu {
    Quaternion orientation;
};

struct Vector3 {
    double x, y, z;
};

struct Twist {
    Vector3 linear;
};

struct TwistWithCovariance {
    Twist twist;
};

struct Odometry {
    TwistWithCovariance twist;
};

struct Range {
    double range;
};
