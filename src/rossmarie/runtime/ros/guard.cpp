// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The loop of the guard: the monitor, the reactor and the filters process messages and time.
#include "guard.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reports.h"

static const double LONGEST_WAIT = 0.05;           // s, wall time between two readings of the clock
static const std::chrono::seconds CHECK_PERIOD{1}; // of other nodes, and of bypasses of the filter

// --- begin ---------------------------------------------------------------------------------------

// Compiler flags and the floating-point mode of the process can change results.
static void must_compute(const char *fault)
{
    if (fault)
        throw std::runtime_error(std::string("the generated C computes wrong results: ") + fault);
}

Guard::Guard(Middleware &middleware, const Settings &settings)
    : middleware_(middleware), settings_(settings)
{
    check(middleware, settings);
    must_compute(core::init(
        &monitor_,
        [](void *guard, const core::Event *event) {
            static_cast<Guard *>(guard)->on_event(*event);
        },
        this));
    must_compute(core::reactor_init(
        &reactor_,
        [](void *guard, int task, core::TaskCommand command, int by_rule) {
            static_cast<Guard *>(guard)->perform(task, command, by_rule);
        },
        this));
    latched_.restore(monitor_);
    bypassed_.publish(Bool());
    performers_ = make_performers(
        *this, {clock_, reactor_, settings_, [this](int64_t now_ns) { catch_up(now_ns); }});
    give(given_, settings_.given);
    values_ = given_;
    subscribe();
    serve();
}

void Guard::subscribe()
{
    const std::vector<std::string> &stamped = settings_.header_stamps;
    const auto by_stamp = [this, &stamped](const char *topic) {
        return std::any_of(stamped.begin(), stamped.end(), [&](const std::string &named) {
            return middleware_.resolved(named) == middleware_.resolved(topic);
        });
    };
    inputs_ = make_inputs({middleware_, clock_, values_, arrays_, by_stamp,
                           [this](int channel, int64_t at_ns) { arrived_ns_[channel] = at_ns; },
                           [this](int64_t at_ns) { take(at_ns); }});
}

void Guard::check(const Middleware &middleware, const Settings &settings)
{
    for (const std::string &topic : settings.header_stamps) {
        const auto found = std::find_if(CHANNELS.begin(), CHANNELS.end(), [&](auto &channel) {
            return middleware.resolved(channel.topic) == middleware.resolved(topic);
        });
        if (found == CHANNELS.end())
            throw BadParameter("header_stamps", "no rule reads " + topic);
        if (!found->has_stamp)
            throw BadParameter("header_stamps", "messages on " + topic + " have no header");
    }
}

std::vector<std::string> Guard::topics()
{
    std::vector<std::string> topics;
    for (const ChannelText &channel : CHANNELS)
        topics.push_back(channel.topic);
    topics.insert(topics.end(), SOURCES.begin(), SOURCES.end());
    return topics;
}

// --- the loop ------------------------------------------------------------------------------------

double Guard::wait()
{
    const double wait = static_cast<double>(next_wake() - clock_.now()) / 1e9;
    return std::max(0.0, std::min(wait, LONGEST_WAIT));
}

// Returns the next instant at which the guard must run without a message.
int64_t Guard::next_wake() const
{
    int64_t wake_ns = std::min(core::next_wake(&monitor_), core::reactor_next_wake(&reactor_));
    for (const auto &task : performers_.tasks)
        wake_ns = std::min(wake_ns, task->next_ns());
    return wake_ns;
}

// Returns the longest standstill of ROS time (ns). During a standstill no input would expire.
int64_t Guard::clock_timeout() const
{
    if (settings_.clock_timeout_ns > 0)
        return settings_.clock_timeout_ns;
    int64_t shortest_ns = 0;
    for (const ChannelText &channel : CHANNELS)
        if (const int64_t timeout_ns = channel.timeout_ns; timeout_ns > 0)
            shortest_ns = shortest_ns == 0 ? timeout_ns : std::min(shortest_ns, timeout_ns);
    return shortest_ns;
}

void Guard::catch_up(int64_t at_ns)
{
    if (has_begun_ && at_ns >= next_wake())
        pass_time(at_ns);
}

void Guard::pass_time(int64_t at_ns)
{
    if (has_stepped_)
        core::advance(&monitor_, at_ns);
    else // the messages and the parameters from before the start
        step_monitor(at_ns);
    for (const auto &task : performers_.tasks)
        task->tick(at_ns);
    follow(at_ns);
}

// Processes a message. Its fields are in values_.
void Guard::take(int64_t at_ns)
{
    if (!begin_when_ready(at_ns))
        return;
    step_monitor(at_ns);
    follow(at_ns);
}

// Passes the collected values to the monitor.
void Guard::step_monitor(int64_t at_ns)
{
    core::step(&monitor_, at_ns, &values_);
    has_stepped_ = true;
    values_ = given_;
}

// Starts the monitor when each input with a timeout has a fresh message, so that a starting input
// does not count as stale. After the time `patience` the monitor starts in any case, without the
// expired messages. The other messages count: they may never arrive again. No command passes before
// the start.
bool Guard::begin_when_ready(int64_t at_ns)
{
    if (has_begun_)
        return true;
    if (started_ns_ == 0)
        started_ns_ = at_ns;
    bool is_ready = at_ns != 0;
    for (int channel = 0; channel < count(CHANNELS); channel++)
        is_ready = is_ready && !is_missing(channel, at_ns);
    const bool is_over = at_ns != 0 && at_ns - started_ns_ >= settings_.patience_ns;
    has_begun_ = is_ready || is_over;
    for (int channel = 0; channel < count(CHANNELS); channel++)
        if (has_begun_ && is_missing(channel, at_ns))
            forget(values_, channel);
    return has_begun_;
}

// Returns true if a channel with a timeout has no message, or an expired message. The age of a
// message that arrived before simulated time began, at 0, is unknown.
bool Guard::is_missing(int channel, int64_t at_ns) const
{
    const int64_t timeout_ns = CHANNELS[channel].timeout_ns;
    const std::optional<int64_t> arrived_ns = arrived_ns_[channel];
    if (!expires(timeout_ns))
        return timeout_ns == FOREVER_NS && !arrived_ns;
    return !arrived_ns || *arrived_ns == 0 || at_ns - *arrived_ns >= timeout_ns;
}

// Processes the passage of time.
void Guard::step()
{
    using Seconds = std::chrono::duration<double>;
    const Wall::time_point now = Wall::now();
    longest_pause_ = std::max(longest_pause_, Seconds(now - looked_).count());
    looked_ = now;
    const int64_t at_ns = clock_.now();
    if (at_ns == 0) { // simulated time has not begun
        if (now - diagnosed_ >= std::chrono::seconds(1))
            publish_diagnostics();
        return;
    }
    if (const int64_t leap_ns = clock_.take_leap(); leap_ns > 0) {
        new_verdicts_.push_back(reports::time_jump(at_ns, "forward", leap_ns));
        say::warning(reports::line(new_verdicts_.back()));
    }
    if (begin_when_ready(at_ns)) {
        pass_time(at_ns);
    } else {
        for (const auto &filter : performers_.filters)
            filter->update(at_ns);
        publish_changes(at_ns);
    }
    if (!is_checking_ && now - checked_ >= CHECK_PERIOD)
        check_others();
    if (now - diagnosed_ >= std::chrono::seconds(1))
        publish_diagnostics();
}

// Runs the reactor. Call this function after each call of the monitor, with the same instant.
void Guard::follow(int64_t at_ns)
{
    end_exemptions(at_ns);
    do {
        core::react(&reactor_, &monitor_, exempted_.data(), at_ns);
    } while (std::exchange(is_reset_wanted_, false) && core::reset(&monitor_, at_ns, -1) >= 0);
    open_when_ready(at_ns);
    for (const auto &filter : performers_.filters)
        filter->update(at_ns);
    publish_changes(at_ns);
}

// Opens the filters when each input with a timeout has received a message.
void Guard::open_when_ready(int64_t at_ns)
{
    if (is_open_)
        return;
    const bool is_ready = core::has_all_inputs(&monitor_);
    const bool is_over = settings_.grace_ns > 0 && at_ns - started_ns_ >= settings_.grace_ns;
    if (!is_ready && !is_over)
        return;
    if (!is_ready)
        say::warning(
            "the grace period has ended: commands pass although some inputs have never arrived");
    is_in_grace_ = !is_ready;
    is_open_ = has_changed_ = true;
    core::reactor_open(&reactor_);
}

void Guard::end_exemptions(int64_t at_ns)
{
    for (int rule = 0; rule < count(RULES); rule++)
        if (exempted_[rule] &&
            (at_ns >= exemptions_[rule].until_ns || Wall::now() >= exemptions_[rule].until)) {
            exempted_[rule] = false;
            has_changed_ = true;
            say::warning(std::string("the exemption of rule ") + RULES[rule].name + " has ended");
        }
}

void Guard::stop_all()
{
    for (const auto &filter : performers_.filters)
        filter->stop();
}

// --- callbacks of the monitor and the reactor ----------------------------------------------------

void Guard::on_event(const core::Event &event)
{
    new_verdicts_.push_back(reports::verdict(event));
    if (event.change == core::CLEARED)
        say::information(reports::line(new_verdicts_.back()));
    else
        say::warning(reports::line(new_verdicts_.back()));
    has_changed_ = true;
    if (event.change == core::CLEARED)
        causes_.erase(event.rule);
    else if (event.change != core::TIME_JUMP)
        causes_[event.rule] = event;
}

void Guard::perform(int task, core::TaskCommand command, int by_rule)
{
    if (static_cast<int>(command) == core::RETRACE) {
        double pose[core::POSE_NUMBERS];
        core::retraced(&reactor_, task, pose);
        performers_.tasks[task]->retrace(clock_.now(), pose);
        return;
    }
    const std::string what = reports::of_task(task);
    has_changed_ = true;
    if (command == core::START) {
        in_force_[task] = true;
        performers_.tasks[task]->start(clock_.now());
        return;
    }
    const bool was_in_force = std::exchange(in_force_[task], false);
    if (was_in_force && command == core::FAILED)
        performers_.tasks[task]->give_up();
    else if (was_in_force)
        performers_.tasks[task]->stop();
    if (command == core::OVERRULED) {
        overruled_.push_back(what + " by rule " + RULES[by_rule].name);
        say::warning("overruled: " + overruled_.back());
    } else if (command == core::FAILED) {
        say::error("failed: " + what);
    }
}

void Guard::report(int task, bool success)
{
    const int64_t at_ns = clock_.now();
    core::advance(&monitor_, at_ns);
    core::report(&reactor_, &monitor_, at_ns, task, success);
    follow(at_ns);
}

void Guard::diagnose(int task, int level, const char *text)
{
    DiagnosticStatus &status = diagnoses_[task];
    status.level = static_cast<decltype(status.level)>(level);
    status.name = std::string("rule ") + RULES[TASKS[task].rule].name;
    status.message = text;
}

void Guard::end_diagnosis(int task) { diagnoses_.erase(task); }
