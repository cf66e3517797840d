#pragma once
#include "geometry_msgs/Twist.h"
#include "middleware.h"
namespace geometry_msgs {
struct Vector3Stamped {
    struct {
        Middleware::Time stamp;
    } header;
    Vector3 vector;
};
} // namespace geometry_msgs
