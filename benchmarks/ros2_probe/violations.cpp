// Violates a rule again and again, and prints the latency of its action: the line of `Lateness`.
//
//   violations RATE COUNT
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
#include <std_msgs/msg/float64.hpp>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "lateness.h"

using std_msgs::msg::Bool;
using std_msgs::msg::Float64;

int main(int argc, char **argv)
{
    rclcpp::init(argc, argv);
    if (argc != 3)
        return EXIT_FAILURE;
    const auto node = std::make_shared<rclcpp::Node>("violations");
    Lateness lateness;
    std::atomic<double> sent{0.0};
    const auto publisher = node->create_publisher<Float64>("/load", 10);
    const auto subscription = node->create_subscription<Bool>(
        "/alarm", 10, [&](const Bool::ConstSharedPtr &) { lateness.note(sent); });
    std::thread spinning([&] { rclcpp::spin(node); });
    while (rclcpp::ok() && (publisher->get_subscription_count() == 0 ||
                            subscription->get_publisher_count() == 0))
        rclcpp::sleep_for(std::chrono::milliseconds(50));
    rclcpp::sleep_for(std::chrono::seconds(1));
    rclcpp::WallRate rate(2.0 * std::atof(argv[1]));
    for (int left = std::atoi(argv[2]); left > 0 && rclcpp::ok(); left--) {
        Float64 load;
        load.data = 2.0;
        sent = now();
        publisher->publish(load);
        rate.sleep();
        load.data = 0.0;
        publisher->publish(load);
        rate.sleep();
    }
    rclcpp::sleep_for(std::chrono::milliseconds(500));
    rclcpp::shutdown();
    spinning.join();
    lateness.print("/alarm");
}
