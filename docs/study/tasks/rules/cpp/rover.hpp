// Safety rules of the rover. The task sheet has the requirements S1 to S4.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "messages.hpp"
#include "timers.hpp"

constexpr double DEG = 3.14159265358979323846 / 180;

constexpr double IMU_TIMEOUT = 0.2;
constexpr double ODOMETRY_TIMEOUT = 0.5;
constexpr double FRONT_TIMEOUT = 0.5;

constexpr double LEVEL[] = {-10 * DEG, 10 * DEG};
constexpr double BRISK = 0.3;
constexpr double FASTEST = 0.8;
constexpr double NEAR = 0.5;

constexpr double CREEP[] = {-0.2, 0.2};

// Keeps the latest messages and changes commands.
class Guard {
public:
    void on_imu(double now, const Imu &message) {
        pitch_ = message.orientation.pitch();
        pitch_at_ = now;
    }

    void on_odometry(double now, const Odometry &message) {
        speed_ = message.twist.twist.linear.x;
        speed_at_ = now;
    }

    void on_front(double now, const Range &message) {
        distance_ = message.range;
        distance_at_ = now;
    }

    // The speed in m/s that the rules permit in the place of the wanted one.
    double command(double now, double wanted) {
        bool no_pitch = now - pitch_at_ > IMU_TIMEOUT || std::isnan(pitch_);
        bool no_speed = now - speed_at_ > ODOMETRY_TIMEOUT || std::isnan(speed_);
        bool no_distance = std::isnan(distance_);
        no_distance = no_distance || now - distance_at_ > FRONT_TIMEOUT;

        bool steep = steep_.update(now, !(LEVEL[0] <= pitch_ && pitch_ <= LEVEL[1]));
        bool fast = speed_ > BRISK;
        bool overspeed = overspeed_.update(now, speed_ > FASTEST);
        bool near = distance_ < NEAR;

        // S1
        bool on_slope = no_pitch || no_speed || (steep && fast);
        bool slow_on_slope = slow_on_slope_.update(now, on_slope);
        // S2
        bool slow_overspeed = slow_overspeed_.update(now, no_speed || overspeed);
        // S3
        bool stop_near = stop_near_.update(now, no_distance || near);

        if (stop_near) return 0;
        if (slow_on_slope || slow_overspeed) return std::max(CREEP[0], std::min(CREEP[1], wanted));
        return wanted;
    }

private:
    static constexpr double NEVER = -std::numeric_limits<double>::infinity();
    double pitch_ = 0, pitch_at_ = NEVER;
    double speed_ = 0, speed_at_ = NEVER;
    double distance_ = 0, distance_at_ = NEVER;
    Lasting steep_{1.0};
    Lasting overspeed_{0.5};
    Rule slow_on_slope_{2.0};
    Rule slow_overspeed_{1.0};
    Rule stop_near_{1.0};
};
