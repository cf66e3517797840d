#pragma once
namespace std_msgs {
struct Float64 {
    double data = 0.0;
};
} // namespace std_msgs
