// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The main program of the node: runs the guard.
#include <ros/ros.h>

#include <csignal>
#include <cstdlib>
#include <memory>

#include "guard.h"
#include "middleware.h"
#include "parameters.h"
#include "rules.h"
#include "settings.h"

static const double SENDING_S = 0.1; // s, time to send the last messages
static volatile std::sig_atomic_t is_ended = 0;

int main(int argc, char **argv)
{
    // If a signal ends the node, the node sends 0 first. So the robot does not keep the last
    // command.
    ros::init(argc, argv, NODE, ros::init_options::NoSigintHandler);
    std::signal(SIGINT, [](int) { is_ended = 1; });
    std::signal(SIGTERM, [](int) { is_ended = 1; });
    const ros::NodeHandle alive; // ROS and its log end with the last handle
    try {
        const Parameters parameters;
        const Settings given = settings(parameters);
        Middleware middleware;
        // The stack is too small for long lists.
        const auto guard = std::make_unique<Guard>(middleware, given);
        say::information("the node is active");
        while (ros::ok() && !is_ended && middleware.is_known_to_master()) {
            middleware.queue().callAvailable(ros::WallDuration(guard->wait()));
            guard->step();
        }
        guard->stop_all();
        ros::WallDuration(SENDING_S).sleep();
        if (!middleware.is_known_to_master()) {
            // roscpp does not register again. The launch file restarts the node, which then
            // registers.
            ROS_FATAL("the ROS master was restarted and does not know this node: the node exits");
            parameters.give_to_master();
            return EXIT_FAILURE;
        }
    } catch (const std::runtime_error &problem) { // BadParameter is one
        ROS_FATAL("%s; no command passes", problem.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
