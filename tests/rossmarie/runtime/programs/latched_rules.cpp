// The file of latched rules survives a restart, belongs to one node, and is never trusted too far.
#include "latched_rules.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "check.h"
#include "descriptions.h"
#include "rules.h"

const std::vector<RuleText> RULES = {
    {"fallen", "", "", true, {}, {}},
    {"steep", "", "", false, {}, {}},
    {"touched", "", "", true, {}, {}},
};
const char *const LATCHED_RULES_KEY = "0123abcd";

static std::string text_of(const std::filesystem::path &path)
{
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

static std::set<int> restored(const std::string &path, const std::string &node = "/robot/guard")
{
    core::Monitor rules;
    LatchedRules(path, node).restore(rules);
    return rules.active;
}

static std::string refusal(const std::string &path)
{
    try {
        LatchedRules(path, "/robot/guard");
    } catch (const BadParameter &problem) {
        return problem.what();
    }
    return "";
}

static void check_file(const std::filesystem::path &folder)
{
    const std::string path = folder / "latched";
    CHECK(restored(path).empty());
    {
        LatchedRules file(path, "/robot/guard");
        core::Monitor rules;
        rules.active = {0, 1};
        file.keep(rules);
        CHECK(file.is_kept());
        CHECK(text_of(path) == "fallen\n"); // a rule that is not latched is not kept
        CHECK(refusal(path).find("is used by another node") != std::string::npos);
    }
    CHECK(restored(path) == std::set<int>({0}));

    std::ofstream(path) << "fallen\nunheard_of\n";
    CHECK(restored(path) == std::set<int>({0, 2}));
    std::ofstream(path) << "";
    CHECK(restored(path).empty());
    CHECK(refusal(folder / "nowhere" / "latched").find("parameter state_file: cannot write") == 0);
}

static void check_disk_that_is_gone(const std::filesystem::path &folder)
{
    const std::filesystem::path stale = folder / "stale";
    std::filesystem::create_directory(stale);
    LatchedRules file(stale / "latched", "/robot/guard");
    std::filesystem::remove_all(stale);
    core::Monitor rules;
    rules.active = {0};
    file.keep(rules);
    CHECK(!file.is_kept());
    CHECK(say::lines.back().find("error: cannot write") == 0);
}

static void check_usual_file(const std::filesystem::path &folder)
{
    setenv("ROS_HOME", folder.c_str(), 1);
    {
        LatchedRules file("", "/robot/guard");
        core::Monitor rules;
        file.keep(rules);
    }
    CHECK(std::filesystem::exists(folder / "robot.guard.0123abcd.latched"));
    CHECK(restored("").empty());

    // What this node left under other rules makes all active; what another left does not.
    std::filesystem::remove(folder / "robot.guard.0123abcd.latched");
    std::ofstream(folder / "robot.guard.arm.4567abcd.latched") << "fallen\n";
    CHECK(restored("").empty());
    std::ofstream(folder / "robot.guard.4567abcd.latched") << "fallen\n";
    CHECK(restored("") == std::set<int>({0, 2}));
}

int main()
{
    const std::filesystem::path folder = std::getenv("ROS_HOME");
    check_file(folder);
    check_disk_that_is_gone(folder);
    check_usual_file(folder);
    std::filesystem::remove_all(folder);
    return result();
}
