// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Stops and starts controllers of a controller manager.
#pragma once

#include <controller_manager_msgs/ListControllers.h>
#include <controller_manager_msgs/SwitchController.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "middleware.h"

using controller_manager_msgs::ListControllers;

class Controllers {
public:
    struct Change {
        std::vector<std::string> start;
        std::vector<std::string> stop;
    };

    Controllers(Middleware &middleware, const std::string &manager)
        : manager_(manager),
          client_(middleware.node().serviceClient<controller_manager_msgs::SwitchController>(
              manager + "/switch_controller"))
    {
    }

    // Makes the changes that this node has not made yet: a manager refuses to start a running
    // controller.
    bool apply(const Change &change)
    {
        const Change rest{undone(change.start, true), undone(change.stop, false)};
        if (!call(rest))
            return false;
        for (const std::string &name : rest.start)
            remember(name, true);
        for (const std::string &name : rest.stop)
            remember(name, false);
        return true;
    }

    void restore()
    {
        Change back;
        for (const auto &[name, is_started] : std::exchange(changed_, {}))
            (is_started ? back.stop : back.start).push_back(name);
        call(back);
    }

private:
    // Makes all changes or none.
    bool call(const Change &change)
    {
        if (change.start.empty() && change.stop.empty())
            return true;
        controller_manager_msgs::SwitchController wanted;
        wanted.request.start_controllers = change.start;
        wanted.request.stop_controllers = change.stop;
        wanted.request.strictness = wanted.request.STRICT;
        const bool is_answered = client_.call(wanted);
        if (!is_answered || !wanted.response.ok)
            say::error(manager_ + " did not switch the controllers: it " +
                       (is_answered ? "refused" : "did not answer"));
        return is_answered && wanted.response.ok;
    }

    std::vector<std::string> undone(const std::vector<std::string> &names, bool is_started) const
    {
        std::vector<std::string> found;
        for (const std::string &name : names) {
            const auto known = changed_.find(name);
            if (known == changed_.end() || known->second != is_started)
                found.push_back(name);
        }
        return found;
    }

    void remember(const std::string &name, bool is_started)
    {
        if (changed_.erase(name) == 0) // otherwise the controller is in its original state again
            changed_[name] = is_started;
    }

    std::string manager_;
    ros::ServiceClient client_;
    std::map<std::string, bool> changed_; // controllers that this node has started or stopped
};
