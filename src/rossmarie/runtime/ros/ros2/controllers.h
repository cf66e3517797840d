// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Stops and starts controllers of a controller manager.
#pragma once

#include <controller_manager_msgs/srv/list_controllers.hpp>
#include <controller_manager_msgs/srv/switch_controller.hpp>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "middleware.h"

using controller_manager_msgs::srv::ListControllers;

class Controllers {
public:
    struct Change {
        std::vector<std::string> start;
        std::vector<std::string> stop;
    };
    using Then = std::function<void(bool success)>;

    Controllers(Middleware &middleware, const std::string &manager)
        : manager_(manager), client_(middleware, manager + "/switch_controller")
    {
    }

    // Makes the changes that this node has not made yet: a manager refuses to start a running
    // controller.
    void apply(const Change &change, Then then)
    {
        const Change rest{undone(change.start, true), undone(change.stop, false)};
        call(rest, [this, rest, then](bool success) {
            if (success) {
                for (const std::string &name : rest.start)
                    remember(name, true);
                for (const std::string &name : rest.stop)
                    remember(name, false);
            }
            then(success);
        });
    }

    void restore(Then then)
    {
        Change back;
        for (const auto &[name, is_started] : std::exchange(changed_, {}))
            (is_started ? back.stop : back.start).push_back(name);
        call(back, then);
    }

private:
    using SwitchController = controller_manager_msgs::srv::SwitchController;

    // Makes all changes or none.
    void call(const Change &change, const Then &then)
    {
        if (change.start.empty() && change.stop.empty())
            return then(true);
        SwitchController::Request wanted;
        wanted.activate_controllers = change.start;
        wanted.deactivate_controllers = change.stop;
        wanted.strictness = SwitchController::Request::STRICT;
        using Answer = SwitchController::Response;
        client_.call(wanted, [this, then](bool has_answered, const Answer &answer) {
            const bool success = has_answered && answer.ok;
            if (!success)
                say::error(manager_ + " did not switch the controllers: it " +
                           (has_answered ? "refused" : "did not answer"));
            then(success);
        });
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
    Client<SwitchController> client_;
    std::map<std::string, bool> changed_; // controllers that this node has started or stopped
};
