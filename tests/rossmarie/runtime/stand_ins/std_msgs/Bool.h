#pragma once
namespace std_msgs {
struct Bool {
    bool data = false;
};
} // namespace std_msgs
