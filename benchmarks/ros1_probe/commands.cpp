// Sends commands along several paths in turn, each at the same rate, and prints the latency at the end
// of each path: the line of `Lateness`.
//
//   commands RATE COUNT IN OUT [IN OUT ...]
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "lateness.h"

class Path {
public:
    Path(ros::NodeHandle &node, const std::string &in, const std::string &out)
        : name_(out), publisher_(node.advertise<geometry_msgs::Twist>(in, 100)),
          subscriber_(node.subscribe(out, 1000, &Path::receive, this,
                                     ros::TransportHints().tcpNoDelay()))
    {
    }

    bool is_connected() const
    {
        return publisher_.getNumSubscribers() > 0 && subscriber_.getNumPublishers() > 0;
    }

    // A number of the command that no rule bounds holds the instant of the publication.
    void send(double at)
    {
        geometry_msgs::Twist command;
        command.linear.x = 0.1;
        command.linear.z = at;
        publisher_.publish(command);
    }

    void print() { lateness_.print(name_); }

private:
    void receive(const geometry_msgs::Twist::ConstPtr &command)
    {
        // Ignore the commands sent to connect, a 0 of the filter itself, and repeated commands.
        if (command->linear.z > latest_)
            lateness_.note(command->linear.z);
        latest_ = std::max(latest_, command->linear.z);
    }

    std::string name_;
    Lateness lateness_;
    double latest_ = 0.0;
    ros::Publisher publisher_;
    ros::Subscriber subscriber_;
};

int main(int argc, char **argv)
{
    ros::init(argc, argv, "commands", ros::init_options::AnonymousName);
    ros::NodeHandle node;
    std::vector<std::unique_ptr<Path>> paths;
    for (int i = 3; i + 1 < argc; i += 2)
        paths.push_back(std::make_unique<Path>(node, argv[i], argv[i + 1]));
    ros::AsyncSpinner spinner(1);
    spinner.start();
    for (const auto &path : paths)
        while (ros::ok() && !path->is_connected()) {
            path->send(0.0); // the relay of topic_tools advertises after its first message
            ros::WallDuration(0.05).sleep();
        }
    ros::WallDuration(1.0).sleep();
    ros::WallRate rate(std::atof(argv[1]) * static_cast<double>(paths.size()));
    for (int left = std::atoi(argv[2]); left > 0 && ros::ok(); left--)
        for (const auto &path : paths) {
            path->send(now());
            rate.sleep();
        }
    ros::WallDuration(0.5).sleep();
    spinner.stop();
    for (const auto &path : paths)
        path->print();
}
