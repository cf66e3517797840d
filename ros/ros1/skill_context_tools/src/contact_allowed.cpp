// Publishes contact_allowed (std_msgs/Bool) ten times a second, for rules and programs that know no
// skills: true while a skill that runs permits contact, false while none does, and false when
// nobody has said for `~patience` seconds which skills run. With `~digest`, skills of another
// export permit nothing.
#include <ros/ros.h>
#include <skill_context_msgs/SkillContext.h>
#include <std_msgs/Bool.h>

#include <algorithm>
#include <string>

static bool permits_contact(const skill_context_msgs::RunningSkill &skill)
{
    return std::any_of(skill.permits.begin(), skill.permits.end(),
                       [](const auto &permission) { return permission.kind == "contact"; });
}

int main(int count, char **arguments)
{
    ros::init(count, arguments, "contact_allowed");
    ros::NodeHandle node;
    const ros::WallDuration patience(ros::param::param("~patience", 0.5));
    const auto digest = ros::param::param<std::string>("~digest", "");
    bool is_allowed = false;
    ros::SteadyTime told;
    const auto contexts = node.subscribe<skill_context_msgs::SkillContext>(
        "skill_context", 1, [&](const skill_context_msgs::SkillContext::ConstPtr &context) {
            told = ros::SteadyTime::now();
            is_allowed =
                (digest.empty() || context->digest == digest) &&
                std::any_of(context->running.begin(), context->running.end(), permits_contact);
        });
    const auto answers = node.advertise<std_msgs::Bool>("contact_allowed", 1);
    const auto timer =
        node.createSteadyTimer(ros::WallDuration(0.1), [&](const ros::SteadyTimerEvent &) {
            std_msgs::Bool answer;
            answer.data = is_allowed && ros::SteadyTime::now() - told < patience;
            answers.publish(answer);
        });
    ros::spin();
    return 0;
}
