// Publishes stamped numbers on /sensor_0, /sensor_1, ..., and prints what it sends as a recording that
// `rossmarie replay` reads: a line for each instant. All are 0 in the last second.
//
//   talker TOPICS RATE SECONDS > recording.csv
#include <geometry_msgs/Vector3Stamped.h>
#include <ros/ros.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// Swings between -2 and 2, on each topic at another pace.
static double number(std::size_t topic, double seconds)
{
    return 2.0 * std::sin(seconds * (1.0 + 0.1 * static_cast<double>(topic)));
}

int main(int argc, char **argv)
{
    ros::init(argc, argv, "talker", ros::init_options::AnonymousName);
    if (argc != 4) {
        std::fprintf(stderr, "talker TOPICS RATE SECONDS\n");
        return EXIT_FAILURE;
    }
    ros::NodeHandle node;
    std::vector<ros::Publisher> topics;
    std::printf("time");
    for (int topic = 0; topic < std::atoi(argv[1]); topic++) {
        const std::string name = "/sensor_" + std::to_string(topic);
        topics.push_back(node.advertise<geometry_msgs::Vector3Stamped>(name, 1000));
        std::printf(",%s.vector.x", name.c_str());
    }
    std::printf("\n");
    for (const ros::Publisher &topic : topics)
        while (ros::ok() && topic.getNumSubscribers() == 0)
            ros::WallDuration(0.05).sleep();
    const ros::Time begin = ros::Time::now();
    const ros::Duration length(std::atof(argv[3]));
    ros::WallRate rate(std::atof(argv[2]));
    for (ros::Time now = begin; ros::ok() && now - begin < length; now = ros::Time::now()) {
        geometry_msgs::Vector3Stamped message;
        message.header.stamp = now;
        const double seconds = (now - begin).toSec();
        const bool is_last_second = seconds > length.toSec() - 1.0;
        std::printf("%.9f", seconds);
        for (std::size_t topic = 0; topic < topics.size(); topic++) {
            message.vector.x = is_last_second ? 0.0 : number(topic, seconds);
            topics[topic].publish(message);
            std::printf(",%.17g", message.vector.x);
        }
        std::printf("\n");
        rate.sleep();
    }
    ros::WallDuration(1.0).sleep(); // so that the last message is on its way
}
