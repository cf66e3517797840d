// A planner that wants 0.7 m/s, as a component.
#include <geometry_msgs/msg/twist.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>

#include <chrono>

namespace ros2_planner {

using geometry_msgs::msg::Twist;

class Planner : public rclcpp::Node {
public:
    explicit Planner(const rclcpp::NodeOptions &options)
        : Node("planner", options), publisher_(create_publisher<Twist>("/cmd_vel", 1)),
          timer_(create_wall_timer(std::chrono::milliseconds(50), [this] { send(); }))
    {
    }

private:
    void send()
    {
        Twist command;
        command.linear.x = 0.7;
        publisher_->publish(command);
    }

    rclcpp::Publisher<Twist>::SharedPtr publisher_;
    rclcpp::TimerBase::SharedPtr timer_;
};

} // namespace ros2_planner

RCLCPP_COMPONENTS_REGISTER_NODE(ros2_planner::Planner)
