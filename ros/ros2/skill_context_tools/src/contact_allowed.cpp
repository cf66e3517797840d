// Publishes contact_allowed (std_msgs/Bool) ten times a second, for rules and programs that know no
// skills: true while a skill that runs permits contact, false while none does, and false when
// nobody has said for `patience` seconds which skills run. With `digest`, skills of another export
// permit nothing.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

#include <rclcpp/rclcpp.hpp>
#include <skill_context_msgs/msg/skill_context.hpp>
#include <std_msgs/msg/bool.hpp>

using skill_context_msgs::msg::RunningSkill;
using skill_context_msgs::msg::SkillContext;
using std_msgs::msg::Bool;
using Clock = std::chrono::steady_clock;

static bool permits_contact(const RunningSkill &skill)
{
    return std::any_of(skill.permits.begin(), skill.permits.end(),
                       [](const auto &permission) { return permission.kind == "contact"; });
}

int main(int count, char **arguments)
{
    rclcpp::init(count, arguments);
    const auto node = std::make_shared<rclcpp::Node>("contact_allowed");
    const std::chrono::duration<double> patience(node->declare_parameter("patience", 0.5));
    const auto digest = node->declare_parameter<std::string>("digest", "");
    bool is_allowed = false;
    Clock::time_point told;
    const auto contexts = node->create_subscription<SkillContext>(
        "skill_context", 1, [&](const SkillContext &context) {
            told = Clock::now();
            is_allowed =
                (digest.empty() || context.digest == digest) &&
                std::any_of(context.running.begin(), context.running.end(), permits_contact);
        });
    const auto answers = node->create_publisher<Bool>("contact_allowed", 1);
    const auto timer = node->create_wall_timer(std::chrono::milliseconds(100), [&] {
        Bool answer;
        answer.data = is_allowed && Clock::now() - told < patience;
        answers->publish(answer);
    });
    rclcpp::spin(node);
    rclcpp::shutdown();
    return 0;
}
