#pragma once
#include "geometry_msgs/Twist.h"
#include <string>
#include <vector>
namespace tf2_msgs {
struct TFMessage {
    struct Each {
        struct {
            std::string frame_id;
        } header;
        std::string child_frame_id;
        struct {
            geometry_msgs::Vector3 translation;
            struct {
                double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
            } rotation;
        } transform;
    };
    std::vector<Each> transforms;
};
} // namespace tf2_msgs
