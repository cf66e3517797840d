// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The node: a lifecycle node and component. While the node is active, the guard runs. Otherwise no
// command passes.
#pragma once

#include <bondcpp/bond.hpp>
#include <lifecycle_msgs/msg/state.hpp>
#include <rcl/timer.h>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include <chrono>
#include <exception>
#include <memory>
#include <mutex>

#include "guard.h"
#include "middleware.h"
#include "parameters.h"
#include "rules.h"
#include "settings.h"

class SafetyNode : public rclcpp_lifecycle::LifecycleNode {
public:
    // The node processes /clock in turn with the messages. With a separate clock thread, ROS time
    // could stand still while messages arrive and jump afterwards, so that all these messages
    // expire.
    explicit SafetyNode(const rclcpp::NodeOptions &options)
        : LifecycleNode(NODE, rclcpp::NodeOptions(options).use_clock_thread(false)),
          parameters_(*this)
    {
        const say::As as(get_logger());
        const auto context = get_node_base_interface()->get_context();
        interrupted_ = context->add_pre_shutdown_callback([this] { stop_robot(); });
        attempt([this] { is_managed_ = !parameters_.autostart(); });
        if (is_managed_)
            return;
        start_ = create_wall_timer(std::chrono::seconds(0), [this] {
            start_->cancel();
            if (configure().id() == State::PRIMARY_STATE_INACTIVE)
                activate();
        });
    }

    ~SafetyNode() override
    {
        get_node_base_interface()->get_context()->remove_pre_shutdown_callback(interrupted_);
        const say::As as(get_logger());
        end();
    }

    CallbackReturn on_configure(const rclcpp_lifecycle::State &) override
    {
        return attempt([this] {
            const Middleware names(*this, [] {});
            std::vector<std::string> topics;
            for (const std::string &topic : Guard::topics())
                topics.push_back(names.resolved(topic));
            parameters_.autostart();
            parameters_.check_quality(topics);
            settings_ = settings(parameters_);
            Guard::check(names, settings_);
        });
    }

    CallbackReturn on_activate(const rclcpp_lifecycle::State &) override
    {
        return attempt([this] {
            auto middleware = std::make_unique<Middleware>(*this, [this] { arm(); });
            auto guard = std::make_unique<Guard>(*middleware, settings_);
            {
                const std::lock_guard<std::mutex> lock(guarding_);
                middleware_ = std::move(middleware);
                guard_ = std::move(guard);
            }
            wake_ = create_wall_timer(std::chrono::seconds(0), [this] { wake(); });
            armed_ = Steady::now();
            if (is_managed_)
                bind();
            say::information("the node is active");
        });
    }

    CallbackReturn on_deactivate(const rclcpp_lifecycle::State &) override
    {
        const say::As as(get_logger());
        if (!guard_->is_kept()) {
            say::error("the node stays active: it cannot save the latched rules");
            return CallbackReturn::FAILURE;
        }
        end();
        say::information("the node is inactive; no command passes");
        return CallbackReturn::SUCCESS;
    }

    CallbackReturn on_shutdown(const rclcpp_lifecycle::State &) override
    {
        const say::As as(get_logger());
        end();
        return CallbackReturn::SUCCESS;
    }

private:
    using State = lifecycle_msgs::msg::State;
    using Steady = std::chrono::steady_clock;

    // Reports an error and does not end the process, which may contain other components.
    template <class Job> CallbackReturn attempt(Job job)
    {
        const say::As as(get_logger());
        try {
            job();
        } catch (const std::exception &problem) {
            say::error(std::string(problem.what()) + "; no command passes");
            return CallbackReturn::FAILURE;
        }
        return CallbackReturn::SUCCESS;
    }

    // Creates a bond. It shows the lifecycle manager of Nav2 that the node is alive.
    void bind()
    {
        bond_ = std::make_unique<bond::Bond>("bond", get_name(), shared_from_this());
        bond_->setHeartbeatPeriod(BOND_PERIOD_S);
        bond_->setHeartbeatTimeout(BOND_TIMEOUT_S);
        bond_->start();
    }

    // Sends 0, so that the robot does not keep the last command. Any thread may call this function.
    void stop_robot()
    {
        const std::lock_guard<std::mutex> lock(guarding_);
        if (guard_)
            guard_->stop_all();
    }

    void end()
    {
        stop_robot();
        const std::lock_guard<std::mutex> lock(guarding_);
        bond_.reset();
        wake_.reset();
        guard_.reset();
        middleware_.reset();
    }

    void wake()
    {
        const say::As as(get_logger());
        middleware_->run_later();
        guard_->step();
        armed_ = Steady::time_point::max();
        arm();
    }

    // Sets the timer to the next necessary step of the guard.
    void arm()
    {
        if (!guard_ || !wake_)
            return;
        using std::chrono::nanoseconds;
        const double wait = middleware_->has_later() ? 0.0 : guard_->wait();
        const auto at = Steady::now() + nanoseconds(static_cast<int64_t>(wait * 1e9));
        if (at >= armed_)
            return;
        armed_ = at;
        int64_t period_ns = 0;
        const auto timer = wake_->get_timer_handle();
        if (rcl_timer_exchange_period(timer.get(), static_cast<int64_t>(wait * 1e9), &period_ns) !=
            RCL_RET_OK)
            throw std::runtime_error("the timer of the node cannot be set");
        wake_->reset();
    }

    static constexpr double BOND_PERIOD_S = 0.1; // the value of the nodes of Nav2
    static constexpr double BOND_TIMEOUT_S = 4.0;

    Parameters parameters_;
    Settings settings_;
    bool is_managed_ = true; // by a lifecycle manager
    rclcpp::PreShutdownCallbackHandle interrupted_;
    rclcpp::TimerBase::SharedPtr start_;
    rclcpp::TimerBase::SharedPtr wake_;
    Steady::time_point armed_; // the instant to which the timer is set
    std::mutex guarding_;      // guards the lifetime of middleware_ and guard_
    std::unique_ptr<Middleware> middleware_;
    std::unique_ptr<Guard> guard_; // after the members that it uses
    std::unique_ptr<bond::Bond> bond_;
};
