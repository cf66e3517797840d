// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// What the generated rules.cpp makes for the guard: inputs, filters and tasks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "any_filter.h"
#include "clock.h"
#include "descriptions.h"
#include "host.h"
#include "input.h"
#include "middleware.h"
#include "rules.h"
#include "settings.h"
#include "stamps.h"
#include "task.h"

using Inputs = std::vector<std::unique_ptr<AnyInput>>;

// Where the fields of messages go; then `take` is called.
struct Listener {
    Middleware &middleware;
    Clock &clock;
    core::Values &values;
    Arrays &arrays;
    std::function<bool(const char *topic)> by_stamp;
    std::function<void(int channel, int64_t at_ns)> take;
};

// An input for each channel.
Inputs make_inputs(const Listener &listener);

// What the parameters of the rules are, for the monitor.
void give(core::Values &values, const std::vector<double> &given);

// What filters need.
struct Filtering {
    Clock &clock;
    const core::Reactor &reactor;
    const Settings &settings;
    CatchUp catch_up;
};

// A filter for each command topic, and the tasks, some of which use a filter.
struct Performers {
    std::vector<std::unique_ptr<AnyFilter>> filters;
    std::vector<std::unique_ptr<Task>> tasks;
};
Performers make_performers(Host &host, const Filtering &filtering);

// A list of structs. Each describes a topic that the node listens to: its `Message`, its `topic`,
// its `timeout_ns`, and `fill(values, arrays, message)`.
template <class... Each> struct Channels {};

template <class Channel> void add_input(Inputs &inputs, const Listener &listener)
{
    using Message = typename Channel::Message;
    const int channel = static_cast<int>(inputs.size());
    inputs.push_back(std::make_unique<Input<Message>>(
        listener.middleware, listener.clock, Channel::topic, Channel::timeout_ns,
        listener.by_stamp(Channel::topic),
        [&values = listener.values, &arrays = listener.arrays, take = listener.take,
         channel](const Message &message, int64_t at_ns) {
            Channel::fill(values, arrays, message);
            take(channel, at_ns);
        }));
}

template <class... Each> Inputs inputs_of(Channels<Each...>, const Listener &listener)
{
    Inputs inputs;
    (add_input<Each>(inputs, listener), ...);
    return inputs;
}

template <class... Each> std::vector<ChannelText> channel_texts(Channels<Each...>)
{
    return {{Each::topic, Each::timeout_ns, has_stamp<typename Each::Message>()}...};
}
