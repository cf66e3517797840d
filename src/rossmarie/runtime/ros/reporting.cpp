// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Publishes verdicts, the state of the node, and diagnostics. Checks other nodes.
#include "guard.h"

#include <utility>

#include "reports.h"

static const double SLOW = 0.1; // minimum pause (s) that diagnostics report

// Indexed by the task states of the generated C.
static const char *const STATES[] = {"idle", "running", "holding", "waiting",
                                     "done", "failed",  "overdue"};

void Guard::publish_changes(int64_t at_ns)
{
    for (Verdict &verdict : std::exchange(new_verdicts_, {})) {
        verdict.overruled = overruled_;
        verdicts_.publish(verdict);
    }
    overruled_.clear();
    for (int task = 0; task < count(TASKS); task++) {
        const int state = core::task_state(&reactor_, task);
        has_changed_ = has_changed_ || state != task_states_[task];
        task_states_[task] = state;
    }
    if (!std::exchange(has_changed_, false))
        return;
    latched_.keep(monitor_);
    publish_state(at_ns);
    publish_diagnostics();
}

void Guard::publish_state(int64_t at_ns)
{
    State state;
    state.at = Middleware::time(at_ns);
    state.open = is_open_;
    for (int rule = 0; rule < count(RULES); rule++) {
        if (core::is_active(&monitor_, rule))
            state.active.push_back(RULES[rule].name);
        if (exempted_[rule])
            state.exempted.push_back(RULES[rule].name);
    }
    for (const auto &filter : performers_.filters)
        if (filter->is_blocked())
            state.blocked.push_back(filter->topic());
    for (int task = 0; task < count(TASKS); task++) {
        if (task_states_[task] == core::TASK_IDLE)
            continue;
        TaskState reported;
        reported.rule = RULES[TASKS[task].rule].name;
        reported.action = TASKS[task].action;
        reported.effect = TASKS[task].effect;
        reported.state = STATES[task_states_[task]];
        state.tasks.push_back(reported);
    }
    state_.publish(state);
}

// --- diagnostics ---------------------------------------------------------------------------------

static void add(std::vector<DiagnosticStatus> &found, const std::string &name, int level,
                const std::string &message)
{
    DiagnosticStatus status;
    status.level = static_cast<decltype(status.level)>(level);
    status.name = name;
    status.message = message;
    found.push_back(status);
}

void Guard::publish_diagnostics()
{
    DiagnosticArray array;
    array.header.stamp = Middleware::time(middleware_.now_ns());
    array.status = statuses();
    const std::string node =
        middleware_.name().substr(1); // the nodes of several robots have different full names
    for (DiagnosticStatus &each : array.status) {
        each.name = node + ": " + each.name;
        each.hardware_id = node;
    }
    diagnostics_.publish(array);
    diagnosed_ = Wall::now();
    longest_pause_ = 0.0;
}

std::vector<DiagnosticStatus> Guard::statuses() const
{
    std::vector<DiagnosticStatus> found;
    add_node_status(found);
    add_input_statuses(found);
    add_rule_statuses(found);
    for (const auto &filter : performers_.filters)
        if (filter->listeners() == 0)
            add(found, "subscribers of " + filter->topic(), DiagnosticStatus::ERROR,
                "none: the robot does not receive the filtered commands");
    for (const auto &filter : performers_.filters)
        if (filter->refused() > 0)
            add(found, "commands on " + filter->topic(), DiagnosticStatus::WARN,
                std::to_string(filter->refused()) + " commands were not finite");
    for (const auto &diagnosis : diagnoses_)
        found.push_back(diagnosis.second);
    return found;
}

void Guard::add_node_status(std::vector<DiagnosticStatus> &found) const
{
    if (longest_pause_ > SLOW)
        add(found, "node", DiagnosticStatus::WARN,
            "the node processed nothing for " + std::to_string(longest_pause_) + " s");
    else if (!latched_.is_kept())
        add(found, "node", DiagnosticStatus::ERROR, "the node cannot save the latched rules");
    else if (clock_.stands_still())
        add(found, "node", DiagnosticStatus::ERROR, "ROS time stands still; no command passes");
    else if (clock_.latest() == 0)
        add(found, "node", DiagnosticStatus::WARN, "waiting for simulated time; no command passes");
    else if (!is_open_)
        add(found, "node", DiagnosticStatus::WARN, "waiting for inputs; no command passes");
    else if (is_in_grace_)
        add(found, "node", DiagnosticStatus::WARN,
            "commands pass without all inputs: the grace period has ended");
    else
        add(found, "node", DiagnosticStatus::OK, "running");
}

void Guard::add_input_statuses(std::vector<DiagnosticStatus> &found) const
{
    for (int input = 0; input < count(INPUTS); input++) {
        const int state = core::input_state(&monitor_, input);
        const bool is_fresh = state == core::FRESH;
        add(found, std::string("input ") + INPUTS[input].name,
            is_fresh ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
            is_fresh ? "messages arrive" : reports::of_input(input, state));
    }
    for (const auto &input : inputs_)
        if (input->refused() > 0)
            add(found, "messages on " + input->topic(), DiagnosticStatus::WARN,
                std::to_string(input->refused()) +
                    " messages were refused; the last one: " + input->reason());
    for (const auto &problem : found_.problems)
        add(found, problem.first, DiagnosticStatus::ERROR, problem.second);
    for (const auto &[topic, by] : found_.bypassed)
        add(found, "commands on " + topic, DiagnosticStatus::ERROR,
            by + " also publishes this topic and bypasses the filter; only 0 passes");
}

void Guard::add_rule_statuses(std::vector<DiagnosticStatus> &found) const
{
    for (int rule = 0; rule < count(RULES); rule++) {
        const std::string name = std::string("rule ") + RULES[rule].name;
        if (core::is_active(&monitor_, rule))
            add(found, name, DiagnosticStatus::WARN, "active: " + why_active(rule));
        if (exempted_[rule])
            add(found, name, DiagnosticStatus::WARN, "exempted: " + exemptions_[rule].reason);
    }
    for (int task = 0; task < count(TASKS); task++) {
        const std::string name = "action " + reports::of_task(task);
        if (task_states_[task] == core::TASK_FAILED)
            add(found, name, DiagnosticStatus::ERROR, "failed");
        else if (task_states_[task] == core::TASK_OVERDUE)
            add(found, name, DiagnosticStatus::ERROR, "overruled for too long");
    }
    for (const auto &[task, missing] : missing_)
        add(found, "action " + reports::of_task(task), DiagnosticStatus::ERROR, missing);
}

// This node cannot stop another node that bypasses the filter. It sends only 0, and reports the
// other node.
void Guard::take_findings(const Findings &found)
{
    for (const auto &[topic, by] : found.bypassed)
        if (found_.bypassed.count(topic) == 0)
            say::error(by + " publishes " + topic + " and bypasses the filter; only 0 passes");
    for (const auto &[topic, by] : found_.bypassed)
        if (found.bypassed.count(topic) == 0)
            say::information("no other node publishes " + topic + " any more");
    const bool has_changed = found.bypassed != found_.bypassed;
    found_ = found;
    checked_ = Wall::now();
    is_checking_ = false;
    if (!has_changed)
        return;
    Bool is_bypassed;
    is_bypassed.data = !found.bypassed.empty();
    bypassed_.publish(is_bypassed);
    has_changed_ = true;
    for (const auto &filter : performers_.filters) {
        filter->bar(found.bypassed.count(filter->topic()) > 0);
        filter->update(clock_.now());
    }
}

// Checks the requirements on other nodes: topics with the expected types, services, action servers
// and controllers. The function does not wait for the results.
void Guard::check_others()
{
    is_checking_ = true;
    std::vector<Need> needs;
    std::vector<std::string> commanded;
    for (const auto &filter : performers_.filters)
        commanded.push_back(filter->topic());
    for (const auto &input : inputs_)
        needs.push_back({"topic " + input->topic(), input->topic(), input->type()});
    for (const auto &filter : performers_.filters)
        needs.push_back(
            {"commands on " + filter->source(), filter->source(), filter->type(), false, true});
    for (const OtherText &other : OTHERS)
        needs.push_back({other.title, middleware_.resolved(other.name), "", other.is_service});
    middleware_.check(needs, commanded, [this](const Findings &found) { take_findings(found); });
    for (int task = 0; task < count(TASKS); task++)
        performers_.tasks[task]->check([this, task](const std::string &missing) {
            missing_.erase(task);
            if (!missing.empty())
                missing_[task] = missing;
        });
}
