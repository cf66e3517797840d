// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Stops and starts controllers of a controller manager, and checks that the manager has them.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "change_task.h"
#include "controllers.h"
#include "middleware.h"

class SwitchTask : public ChangeTask<Controllers> {
public:
    SwitchTask(Middleware &middleware, const std::string &manager,
               std::shared_ptr<Shared<Controllers>> shared, const Controllers::Change &change,
               Report report)
        : ChangeTask(std::move(shared), change, std::move(report)), manager_(manager),
          switched_(change.start), list_(middleware, manager + "/list_controllers")
    {
        switched_.insert(switched_.end(), change.stop.begin(), change.stop.end());
    }

    void check(std::function<void(const std::string &missing)> report) override
    {
        if (!list_.is_free())
            return;
        const ListControllers::Request all;
        using Answer = ListControllers::Response;
        list_.call(all, [this, report](bool has_answered, const Answer &answer) {
            // Guard::check_others reports a missing manager.
            report(has_answered ? missing(answer) : "");
        });
    }

private:
    std::string missing(const ListControllers::Response &present) const
    {
        std::string names;
        for (const std::string &name : switched_)
            if (std::none_of(present.controller.begin(), present.controller.end(),
                             [&](const auto &each) { return each.name == name; }))
                names += (names.empty() ? "" : ", ") + name;
        return names.empty() ? "" : manager_ + " has no controller " + names;
    }

    std::string manager_;
    std::vector<std::string> switched_;
    Client<ListControllers> list_;
};
