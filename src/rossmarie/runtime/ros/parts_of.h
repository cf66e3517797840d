// Part of ROSSMARie, the same in each package: SHA256SUMS lists it. Change nothing here.
//
// The parts of a guard of certain rules. `Code` lists what these rules take and bound:
//
// - Code::Channels: for each topic a struct with its `Message`, `topic`, `timeout_ns`, and with
//   `fill(values, arrays, message)`;
// - Code::Commands: for each command topic a struct as filter.h needs it;
// - Code::make_tasks(host, filters);
// - the names of the C (core_of.h).
#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "command_task.h"
#include "core_of.h"
#include "descriptions.h"
#include "filter.h"
#include "parts.h"
#include "stamps.h"

// The filters of commands, by the struct that describes each.
template <class Commands> class FiltersOf;
template <class... Each> class FiltersOf<Types<Each...>> {
public:
    template <class... Arguments> void make(Arguments &...arguments)
    {
        filters_ = {std::make_unique<Filter<Each>>(arguments...)...};
    }

    template <class Command> Filter<Command> &of() const
    {
        return *std::get<std::unique_ptr<Filter<Command>>>(filters_);
    }

    std::vector<AnyFilter *> all() const { return {&of<Each>()...}; }

private:
    std::tuple<std::unique_ptr<Filter<Each>>...> filters_;
};

template <class Code> class PartsOf : public Parts {
public:
    Core &core() override { return core_; }

    std::vector<AnyFilter *> make_filters(Middleware &middleware, Clock &clock,
                                          const Settings &settings,
                                          const CatchUp &catch_up) override
    {
        filters_.make(middleware, clock, core_, settings, catch_up);
        return filters_.all();
    }

    std::vector<std::unique_ptr<Task>> make_tasks(Host &host) override
    {
        return Code::make_tasks(host, filters_);
    }

    std::vector<std::unique_ptr<AnyInput>>
    make_inputs(Middleware &middleware, Clock &clock,
                const std::function<bool(const char *topic)> &by_stamp, const Take &take) override
    {
        std::vector<std::unique_ptr<AnyInput>> inputs;
        each_channel(typename Code::Channels(), [&](auto channel, int index) {
            using Channel = decltype(channel);
            using Message = typename Channel::Message;
            inputs.push_back(std::make_unique<Input<Message>>(
                middleware, clock, Channel::topic, Channel::timeout_ns, by_stamp(Channel::topic),
                [this, take, index](const Message &message, int64_t at_ns) {
                    Channel::fill(core_.values, core_.arrays, message);
                    take(index, at_ns);
                }));
        });
        return inputs;
    }

private:
    template <class... Each, class Visit> static void each_channel(Types<Each...>, Visit visit)
    {
        [[maybe_unused]] int index = 0;
        (visit(Each(), index++), ...);
    }

    CoreOf<Code> core_;
    FiltersOf<typename Code::Commands> filters_; // they use the core
};

// The table of the topics of rules.
template <class... Each> std::vector<ChannelText> channel_texts(Types<Each...>)
{
    return {{Each::topic, Each::timeout_ns, has_stamp<typename Each::Message>()}...};
}

// The table of the topics that commands come from.
template <class... Each> std::vector<std::string> sources(Types<Each...>)
{
    return {Each::source...};
}
