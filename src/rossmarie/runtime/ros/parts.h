// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The parts of the guard that the generated rules.cpp makes: inputs, filters and tasks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
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

// The receiver of the fields of messages. A message calls `arrive` for each channel that it
// updates, and then `take`.
struct Listener {
    Middleware &middleware;
    Clock &clock;
    core::Values &values;
    Arrays &arrays;
    std::function<bool(const char *topic)> by_stamp;
    std::function<void(int channel, int64_t at_ns)> arrive;
    std::function<void(int64_t at_ns)> take;
};

// Makes an input for each channel.
Inputs make_inputs(const Listener &listener);

// Removes the message of a channel from the values for the next step of the monitor.
void forget(core::Values &values, int channel);

// Copies the parameters of the rules into the values for the monitor.
void give(core::Values &values, const std::vector<double> &given);

// The objects that filters use.
struct Filtering {
    Clock &clock;
    const core::Reactor &reactor;
    const Settings &settings;
    CatchUp catch_up;
};

// A filter for each command topic, and the tasks. Some tasks use a filter.
struct Performers {
    std::vector<std::unique_ptr<AnyFilter>> filters;
    std::vector<std::unique_ptr<Task>> tasks;
};
Performers make_performers(Host &host, const Filtering &filtering);

// A list of structs. Each struct describes a topic that the node subscribes to: its `Message` type,
// `topic`, `timeout_ns`, `fill(values, arrays, message)`, and `forget(values)`. A struct with
// `has(message)` shares its topic with other structs: it receives the messages for which `has`
// returns true.
template <class... Each> struct Channels {};

template <class Channel> auto shares(int) -> decltype(&Channel::has, std::true_type());
template <class Channel> std::false_type shares(long);
template <class Channel> constexpr bool is_shared = decltype(shares<Channel>(0))::value;

// Copies the content of a message for a channel that shares its topic with the subscribing channel.
template <class Listening, class Channel>
bool take_over(const Listener &listener, const typename Listening::Message &message, int channel,
               int64_t at_ns)
{
    if constexpr (is_shared<Channel>)
        if (std::string(Channel::topic) == Listening::topic && Channel::has(message)) {
            Channel::fill(listener.values, listener.arrays, message);
            listener.arrive(channel, at_ns);
            return true;
        }
    return false;
}

template <class Channel, class... Each>
void add_input(Inputs &inputs, const Listener &listener, std::vector<std::string> &heard)
{
    using Message = typename Channel::Message;
    const int channel = static_cast<int>(inputs.size());
    std::function<void(const Message &, int64_t)> take = [listener, channel](const Message &message,
                                                                             int64_t at_ns) {
        Channel::fill(listener.values, listener.arrays, message);
        listener.arrive(channel, at_ns);
        listener.take(at_ns);
    };
    if constexpr (is_shared<Channel>) {
        if (std::find(heard.begin(), heard.end(), Channel::topic) != heard.end()) {
            inputs.push_back(std::make_unique<SharedInput>(
                listener.middleware.resolved(Channel::topic), Middleware::type<Message>()));
            return;
        }
        heard.emplace_back(Channel::topic);
        take = [listener](const Message &message, int64_t at_ns) {
            int each = 0;
            bool is_for_any = false;
            ((is_for_any |= take_over<Channel, Each>(listener, message, each++, at_ns)), ...);
            if (is_for_any)
                listener.take(at_ns);
        };
    }
    inputs.push_back(std::make_unique<Input<Message>>(listener.middleware, listener.clock,
                                                      Channel::topic, Channel::timeout_ns,
                                                      listener.by_stamp(Channel::topic), take));
}

template <class... Each> Inputs inputs_of(Channels<Each...>, const Listener &listener)
{
    Inputs inputs;
    std::vector<std::string> heard; // the topics that several channels share
    (add_input<Each, Each...>(inputs, listener, heard), ...);
    return inputs;
}

// Removes the message of the channel with an index.
template <class... Each>
void forget_in(Channels<Each...>, [[maybe_unused]] core::Values &values,
               [[maybe_unused]] int channel)
{
    [[maybe_unused]] int each = 0;
    ((each++ == channel ? Each::forget(values) : void()), ...);
}

template <class... Each> std::vector<ChannelText> channel_texts(Channels<Each...>)
{
    return {{Each::topic, Each::timeout_ns, has_stamp<typename Each::Message>()}...};
}
