// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//  The node: a component with a life cycle. While it is active, the guard runs; otherwise no
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
    // Simulated time comes in turn with the messages. On a thread of its own it may stand still
    // while they arrive and then jump, so that all of them count as old.
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
            say::error("stays active: latched rules cannot be kept, and would be forgotten");
            return CallbackReturn::FAILURE;
        }
        end();
        say::information("the node is not active; no command passes");
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

    // No error ends the process, because other components may live in it.
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

    // Lifecycle managers of Nav2 notice by a bond that a node has died.
    void bind()
    {
        bond_ = std::make_unique<bond::Bond>("bond", get_name(), shared_from_this());
        bond_->setHeartbeatPeriod(BOND_PERIOD_S);
        bond_->setHeartbeatTimeout(BOND_TIMEOUT_S);
        bond_->start();
    }

    // The robot is not left with the last command, whichever program and thread ends the process.
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

    // Lets the timer wake the guard when it has something to do.
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

    static constexpr double BOND_PERIOD_S = 0.1; // as the nodes of Nav2 have it
    static constexpr double BOND_TIMEOUT_S = 4.0;

    Parameters parameters_;
    Settings settings_;
    bool is_managed_ = true; // by somebody else
    rclcpp::PreShutdownCallbackHandle interrupted_;
    rclcpp::TimerBase::SharedPtr start_;
    rclcpp::TimerBase::SharedPtr wake_;
    Steady::time_point armed_; // for when the timer is set
    std::mutex guarding_;      // the life of what stands below
    std::unique_ptr<Middleware> middleware_;
    std::unique_ptr<Guard> guard_; // after what it uses
    std::unique_ptr<bond::Bond> bond_;
};
