// Sends commands along several paths in turn, each at the same rate, and prints the latency at the end
// of each path: the line of `Lateness`.
//
//   commands RATE COUNT IN OUT [IN OUT ...]
#include <geometry_msgs/msg/twist.hpp>
#include <rclcpp/rclcpp.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "lateness.h"

using geometry_msgs::msg::Twist;

class Path {
public:
    Path(rclcpp::Node &node, const std::string &in, const std::string &out)
        : name_(out), publisher_(node.create_publisher<Twist>(in, 100)),
          subscription_(node.create_subscription<Twist>(
              out, 1000, [this](const Twist::ConstSharedPtr &command) { receive(*command); }))
    {
    }

    bool is_connected() const
    {
        return publisher_->get_subscription_count() > 0 && subscription_->get_publisher_count() > 0;
    }

    // A number of the command that no rule bounds holds the instant of the publication.
    void send(double at)
    {
        Twist command;
        command.linear.x = 0.1;
        command.linear.z = at;
        publisher_->publish(command);
    }

    void print() { lateness_.print(name_); }

private:
    void receive(const Twist &command)
    {
        // Ignore a 0 of the filter itself, and repeated commands.
        if (command.linear.z > latest_)
            lateness_.note(command.linear.z);
        latest_ = std::max(latest_, command.linear.z);
    }

    std::string name_;
    Lateness lateness_;
    double latest_ = 0.0;
    rclcpp::Publisher<Twist>::SharedPtr publisher_;
    rclcpp::Subscription<Twist>::SharedPtr subscription_;
};

int main(int argc, char **argv)
{
    rclcpp::init(argc, argv);
    const auto node = std::make_shared<rclcpp::Node>("commands");
    std::vector<std::unique_ptr<Path>> paths;
    for (int i = 3; i + 1 < argc; i += 2)
        paths.push_back(std::make_unique<Path>(*node, argv[i], argv[i + 1]));
    std::thread spinning([&] { rclcpp::spin(node); });
    for (const auto &path : paths)
        while (rclcpp::ok() && !path->is_connected())
            rclcpp::sleep_for(std::chrono::milliseconds(50));
    rclcpp::sleep_for(std::chrono::seconds(1));
    rclcpp::WallRate rate(std::atof(argv[1]) * static_cast<double>(paths.size()));
    for (int left = std::atoi(argv[2]); left > 0 && rclcpp::ok(); left--)
        for (const auto &path : paths) {
            path->send(now());
            rate.sleep();
        }
    rclcpp::sleep_for(std::chrono::milliseconds(500));
    rclcpp::shutdown();
    spinning.join();
    for (const auto &path : paths)
        path->print();
}
