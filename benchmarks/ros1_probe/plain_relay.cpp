// A filter that does nothing, with the settings of the generated node. It is a second reference beside
// the relay of topic_tools, which waits for full packets (no TCP_NODELAY).
//
//   plain_relay IN OUT
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <cstdlib>

int main(int argc, char **argv)
{
    ros::init(argc, argv, "plain_relay");
    if (argc != 3)
        return EXIT_FAILURE;
    ros::NodeHandle node;
    const ros::Publisher publisher = node.advertise<geometry_msgs::Twist>(argv[2], 10);
    const boost::function<void(const geometry_msgs::Twist::ConstPtr &)> receive =
        [&](const geometry_msgs::Twist::ConstPtr &command) { publisher.publish(command); };
    const ros::Subscriber subscriber = node.subscribe<geometry_msgs::Twist>(
        argv[1], 10, receive, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    ros::spin();
}
