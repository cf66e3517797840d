#pragma once
#include "middleware.h"
#include <string>
namespace geometry_msgs {
struct PointStamped {
    struct {
        Middleware::Time stamp;
        std::string frame_id;
    } header;
    struct {
        double x = 0.0, y = 0.0, z = 0.0;
    } point;
};
} // namespace geometry_msgs
