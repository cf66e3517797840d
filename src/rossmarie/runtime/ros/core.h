// Part of ROSSMARie, the same in each package: SHA256SUMS lists it. Change nothing here.
//
// The C of the rules, as the node sees it. The monitor says which rules are active; the reactor
// says what follows, and which bounds lie on the commands that pass. Rules, inputs, tasks, commands
// and fields are told by their index. What each function means stands in the headers of the C.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

// The values of these are those in the C.
enum class Change { CLEARED, ACTIVATED, ACTIVATED_LOST, TIME_JUMP };
enum class InputState { NEVER_RECEIVED, FRESH, EXPIRED };
enum class Order { START, STOP, OVERRULED, FAILED };
enum class TaskStatus { IDLE, RUNNING, HOLDING, WAITING, DONE, FAILED, OVERDUE };

// What lies on a field of a command.
struct Bounds {
    double factor;
    double low;
    double high;
};

// One change of one rule, and what the rule rested on; of a time jump only the instants matter.
struct Event {
    int64_t at_ns;
    int64_t from_ns;
    int rule;
    Change change;
    std::vector<double> values;
    std::vector<InputState> inputs;
};

class Core {
public:
    using OnEvent = std::function<void(const Event &)>;
    using Perform = std::function<void(int task, Order order, int by_rule)>;

    Core() = default;
    virtual ~Core() = default;
    Core(const Core &) = delete;
    Core &operator=(const Core &) = delete;

    // To be called once, before all else. Throws std::runtime_error if the C was compiled with
    // flags that change results, or if the process changes them.
    virtual void begin(OnEvent on_event, Perform perform) = 0;

    // --- the monitor

    virtual void latch(int rule) = 0;

    // The messages that have been filled in since the last step arrive, or are forgotten.
    virtual void step(int64_t at_ns) = 0;
    virtual void drop_messages() = 0;

    virtual void advance(int64_t at_ns) = 0;
    virtual bool reset(int64_t at_ns, int rule) = 0; // false: the instant is out of range
    virtual int64_t next_wake() const = 0;           // of the reactor as well
    virtual bool is_active(int rule) const = 0;
    virtual InputState input_state(int input) const = 0;
    virtual bool has_all_inputs() const = 0;

    // --- the reactor

    virtual void open() = 0;
    virtual void react(const std::vector<unsigned char> &exempted, int64_t at_ns) = 0;
    virtual void report(int64_t at_ns, int task, bool success) = 0;
    virtual TaskStatus task_state(int task) const = 0;
    virtual void bounds_of(int command, int64_t at_ns, Bounds *bounds,
                           std::size_t fields) const = 0;
    virtual double bounded(const Bounds &bounds, double number) const = 0;
};
