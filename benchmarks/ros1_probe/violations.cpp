// Violates a rule again and again, and prints the latency of its action: the line of `Lateness`.
//
//   violations RATE COUNT
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <atomic>
#include <cstdlib>

#include "lateness.h"

int main(int argc, char **argv)
{
    ros::init(argc, argv, "violations", ros::init_options::AnonymousName);
    if (argc != 3)
        return EXIT_FAILURE;
    ros::NodeHandle node;
    Lateness lateness;
    std::atomic<double> sent{0.0};
    const boost::function<void(const std_msgs::Bool::ConstPtr &)> receive =
        [&](const std_msgs::Bool::ConstPtr &) { lateness.note(sent); };
    const ros::Publisher publisher = node.advertise<std_msgs::Float64>("/load", 10);
    const ros::Subscriber subscriber = node.subscribe<std_msgs::Bool>(
        "/alarm", 10, receive, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    ros::AsyncSpinner spinner(1);
    spinner.start();
    while (ros::ok() && (publisher.getNumSubscribers() == 0 || subscriber.getNumPublishers() == 0))
        ros::WallDuration(0.05).sleep();
    ros::WallDuration(1.0).sleep();
    ros::WallRate rate(2.0 * std::atof(argv[1]));
    for (int left = std::atoi(argv[2]); left > 0 && ros::ok(); left--) {
        std_msgs::Float64 load;
        load.data = 2.0;
        sent = now();
        publisher.publish(load);
        rate.sleep();
        load.data = 0.0;
        publisher.publish(load);
        rate.sleep();
    }
    ros::WallDuration(0.5).sleep();
    spinner.stop();
    lateness.print("/alarm");
}
