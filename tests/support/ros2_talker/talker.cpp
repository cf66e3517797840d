// Publishes stamped numbers on /sensor_0, /sensor_1, ..., and prints what it sends as a recording that
// `rossmarie replay` reads: a line for each instant. All are 0 in the last second.
//
//   talker TOPICS RATE SECONDS > recording.csv
#include <geometry_msgs/msg/vector3_stamped.hpp>
#include <rclcpp/rclcpp.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using geometry_msgs::msg::Vector3Stamped;

// Swings between -2 and 2, on each topic at another pace.
static double number(std::size_t topic, double seconds)
{
    return 2.0 * std::sin(seconds * (1.0 + 0.1 * static_cast<double>(topic)));
}

int main(int argc, char **argv)
{
    rclcpp::init(argc, argv);
    if (argc != 4) {
        std::fprintf(stderr, "talker TOPICS RATE SECONDS\n");
        return EXIT_FAILURE;
    }
    const auto node = std::make_shared<rclcpp::Node>("talker");
    std::vector<rclcpp::Publisher<Vector3Stamped>::SharedPtr> topics;
    std::printf("time");
    for (int topic = 0; topic < std::atoi(argv[1]); topic++) {
        const std::string name = "/sensor_" + std::to_string(topic);
        topics.push_back(node->create_publisher<Vector3Stamped>(name, 1000));
        std::printf(",%s.vector.x", name.c_str());
    }
    std::printf("\n");
    for (const auto &topic : topics)
        while (rclcpp::ok() && topic->get_subscription_count() == 0)
            rclcpp::sleep_for(std::chrono::milliseconds(50));
    const rclcpp::Time begin = node->now();
    const double length = std::atof(argv[3]);
    rclcpp::WallRate rate(std::atof(argv[2]));
    for (rclcpp::Time now = begin; rclcpp::ok() && (now - begin).seconds() < length;
         now = node->now()) {
        Vector3Stamped message;
        message.header.stamp = now;
        const double seconds = (now - begin).seconds();
        const bool is_last_second = seconds > length - 1.0;
        std::printf("%.9f", seconds);
        for (std::size_t topic = 0; topic < topics.size(); topic++) {
            message.vector.x = is_last_second ? 0.0 : number(topic, seconds);
            topics[topic]->publish(message);
            std::printf(",%.17g", message.vector.x);
        }
        std::printf("\n");
        rate.sleep();
    }
    rclcpp::sleep_for(std::chrono::seconds(1)); // so that the last message is on its way
    rclcpp::shutdown();
}
