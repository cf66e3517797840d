// Part of ROSSMARie, the same in each package: SHA256SUMS lists it. Change nothing here.
//
// The parts of a guard that differ from rules to rules. The generated rules.cpp makes them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "any_filter.h"
#include "clock.h"
#include "core.h"
#include "host.h"
#include "input.h"
#include "middleware.h"
#include "settings.h"
#include "task.h"

class Parts {
public:
    virtual ~Parts() = default;

    virtual Core &core() = 0;

    // Begins to let commands pass. The filters live as long as this.
    virtual std::vector<AnyFilter *> make_filters(Middleware &middleware, Clock &clock,
                                                  const Settings &settings,
                                                  const CatchUp &catch_up) = 0;

    // The tasks, in their order; they use the filters.
    virtual std::vector<std::unique_ptr<Task>> make_tasks(Host &host) = 0;

    // Begins to listen to all channels. `take` is called when the core has been given a message.
    using Take = std::function<void(int channel, int64_t at_ns)>;
    virtual std::vector<std::unique_ptr<AnyInput>>
    make_inputs(Middleware &middleware, Clock &clock,
                const std::function<bool(const char *topic)> &by_stamp, const Take &take) = 0;
};

std::unique_ptr<Parts> make_parts();
