// A filter that does nothing, with the settings of the generated node: the reference.
//
//   plain_relay IN OUT
#include <geometry_msgs/msg/twist.hpp>
#include <rclcpp/rclcpp.hpp>

#include <cstdlib>

using geometry_msgs::msg::Twist;

int main(int argc, char **argv)
{
    rclcpp::init(argc, argv);
    if (argc != 3)
        return EXIT_FAILURE;
    const auto node = std::make_shared<rclcpp::Node>("plain_relay");
    const auto publisher = node->create_publisher<Twist>(argv[2], 10);
    const auto subscription = node->create_subscription<Twist>(
        argv[1], 10, [&](const Twist::ConstSharedPtr &command) { publisher->publish(*command); });
    rclcpp::spin(node);
    rclcpp::shutdown();
}
