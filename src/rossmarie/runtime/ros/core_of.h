// Part of ROSSMARie, the same in each package: SHA256SUMS lists it. Change nothing here.
//
// The core of certain rules. `Code` has the names of their C, as the generated rules.cpp lists
// them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core.h"
#include "descriptions.h"

// A list of types.
template <class... Each> struct Types {
    static constexpr int count = sizeof...(Each);
};

// The most fields that one of these commands has, 1 at least.
template <class... Each> constexpr std::size_t most_fields(Types<Each...>)
{
    return std::max({std::size_t{1}, Each::fields...});
}

template <class Code> class CoreOf : public Core {
public:
    // The fields of the messages that come next, and the arrays that these fields are in.
    typename Code::Values values{};
    typename Code::Arrays arrays{};

    void begin(OnEvent on_event, Perform perform) override
    {
        on_event_ = std::move(on_event);
        perform_ = std::move(perform);
        must_compute(Code::init(
            &monitor_,
            [](void *core, const CodeEvent *event) { static_cast<CoreOf *>(core)->tell(*event); },
            this));
        must_compute(Code::reactor_init(
            &reactor_,
            [](void *core, int task, typename Code::Order order, int by_rule) {
                static_cast<CoreOf *>(core)->perform_(task, static_cast<::Order>(order), by_rule);
            },
            this));
    }

    void latch(int rule) override { Code::latch(&monitor_, rule); }

    void step(int64_t at_ns) override
    {
        Code::step(&monitor_, at_ns, &values);
        drop_messages();
    }

    void drop_messages() override { values = {}; }
    void advance(int64_t at_ns) override { Code::advance(&monitor_, at_ns); }

    bool reset(int64_t at_ns, int rule) override
    {
        return Code::reset(&monitor_, at_ns, rule) >= 0;
    }

    int64_t next_wake() const override
    {
        return std::min(Code::next_wake(&monitor_), Code::reactor_next_wake(&reactor_));
    }

    bool is_active(int rule) const override { return Code::is_active(&monitor_, rule); }

    InputState input_state(int input) const override
    {
        return static_cast<InputState>(Code::input_state(&monitor_, input));
    }

    bool has_all_inputs() const override { return Code::has_all_inputs(&monitor_); }
    void open() override { Code::reactor_open(&reactor_); }

    void react(const std::vector<unsigned char> &exempted, int64_t at_ns) override
    {
        Code::react(&reactor_, &monitor_, exempted.data(), at_ns);
    }

    void report(int64_t at_ns, int task, bool success) override
    {
        Code::report(&reactor_, &monitor_, at_ns, task, success);
    }

    TaskStatus task_state(int task) const override
    {
        return static_cast<TaskStatus>(Code::task_state(&reactor_, task));
    }

    void bounds_of([[maybe_unused]] int command, [[maybe_unused]] int64_t at_ns, Bounds *bounds,
                   std::size_t fields) const override
    {
        std::fill_n(bounds, fields, Bounds{0.0, 0.0, 0.0});
        if constexpr (Code::Commands::count > 0) {
            typename Code::Bounds found[most_fields(typename Code::Commands())];
            Code::bounds_of(&reactor_, at_ns, command, found);
            std::transform(found, found + fields, bounds, [](const typename Code::Bounds &each) {
                return Bounds{each.factor, each.low, each.high};
            });
        }
    }

    double bounded([[maybe_unused]] const Bounds &bounds,
                   [[maybe_unused]] double number) const override
    {
        if constexpr (Code::Commands::count > 0)
            return Code::bounded({bounds.factor, bounds.low, bounds.high}, number);
        else
            return 0.0;
    }

private:
    using CodeEvent = typename Code::Event;

    static_assert(Code::last_change == static_cast<int>(Change::TIME_JUMP));
    static_assert(Code::last_input_state == static_cast<int>(InputState::EXPIRED));
    static_assert(Code::last_order == static_cast<int>(Order::FAILED));
    static_assert(Code::last_task_state == static_cast<int>(TaskStatus::OVERDUE));

    // Whoever compiled the C did so with flags that change results, or the process changes them.
    static void must_compute(const char *fault)
    {
        if (fault != nullptr)
            throw std::runtime_error(std::string("the core computes wrongly: ") + fault);
    }

    void tell(const CodeEvent &event)
    {
        Event told{event.at_ns, event.from_ns, event.rule, static_cast<Change>(event.change), {},
                   {}};
        if (told.change != Change::TIME_JUMP) {
            const RuleText &rule = RULES[static_cast<std::size_t>(event.rule)];
            told.values.assign(event.values, event.values + rule.values.size());
            for (std::size_t input = 0; input < rule.inputs.size(); input++)
                told.inputs.push_back(static_cast<InputState>(event.inputs[input]));
        }
        on_event_(told);
    }

    typename Code::Monitor monitor_{};
    typename Code::Reactor reactor_{};
    OnEvent on_event_;
    Perform perform_;
};
