// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The file that keeps the latched rules over a restart: one rule name on each line. The file
// belongs to one node. A lock file next to it excludes other nodes. The default file name contains
// the name of the node and a key of its latched rules.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "descriptions.h"
#include "middleware.h"
#include "rules.h"
#include "settings.h"

class LatchedRules {
public:
    // An empty `path` means the default path. `node` is the full name of the node. Throws
    // BadParameter if the file is not writable, or if another node uses the file.
    LatchedRules(std::string path, const std::string &node) : path_(std::move(path))
    {
        if (!has_any())
            return;
        if (path_.empty()) {
            const std::string folder = usual_folder(), family = node_in_file_name(node) + ".";
            path_ = folder + "/" + family + LATCHED_RULES_KEY + ENDING;
            relatives_ = files(folder, family);
        }
        take();
    }

    ~LatchedRules()
    {
        if (lock_ >= 0)
            close(lock_);
    }

    LatchedRules(const LatchedRules &) = delete;
    LatchedRules &operator=(const LatchedRules &) = delete;

    // Latches the rules that the file names. Latches all latched rules if the intended content is
    // unknown: the file is not readable, or the file names another rule, or the file does not exist
    // and this node left a non-empty file of another set of rules.
    void restore(core::Monitor &monitor)
    {
        if (!has_any())
            return;
        std::set<std::string> names;
        std::string stranger;
        if (access(path_.c_str(), F_OK) == 0)
            stranger = is_read(path_, names) ? "" : path_;
        else
            for (const std::string &relative : relatives_)
                stranger = is_empty(relative) ? stranger : relative;
        for (int rule = 0; rule < count(RULES); rule++)
            if (RULES[rule].is_latched && (!stranger.empty() || names.count(RULES[rule].name) > 0))
                core::latch(&monitor, rule);
        if (!stranger.empty())
            say::error(stranger + " names other rules: all latched rules are active");
    }

    // Writes the active latched rules if they have changed. After a crash, either the complete new
    // file or the complete old file exists.
    void keep(const core::Monitor &monitor)
    {
        std::string text;
        for (int rule = 0; rule < count(RULES); rule++)
            if (RULES[rule].is_latched && core::is_active(&monitor, rule))
                text += std::string(RULES[rule].name) + "\n";
        if (!has_any() || (has_written_ && text == written_))
            return;
        is_kept_ = write_whole(text);
        has_written_ = true;
        written_ = text;
        if (!is_kept_)
            say::error("cannot write " + path_ + ": the latched rules will not survive a restart");
    }

    bool is_kept() const { return is_kept_; }

private:
    static constexpr const char *ENDING = ".latched";

    static bool has_any()
    {
        return std::any_of(RULES.begin(), RULES.end(), [](auto &rule) { return rule.is_latched; });
    }

    static bool is_latched(const std::string &name)
    {
        return std::any_of(RULES.begin(), RULES.end(), [&name](const RuleText &rule) {
            return rule.is_latched && name == rule.name;
        });
    }

    // Returns the data folder of ROS.
    static std::string usual_folder()
    {
        const char *ros_home = std::getenv("ROS_HOME");
        const char *home = std::getenv("HOME");
        const std::string folder = ros_home != nullptr ? ros_home
                                   : home != nullptr   ? std::string(home) + "/.ros"
                                                       : ".";
        mkdir(folder.c_str(), 0755); // fails without effect if the folder exists
        return folder;
    }

    // Converts `/robot1/slope_safety` to `robot1.slope_safety`. ROS names contain no dots.
    static std::string node_in_file_name(const std::string &node)
    {
        std::string name = node.substr(node.find_first_not_of('/'));
        for (char &letter : name)
            letter = letter == '/' ? '.' : letter;
        return name;
    }

    // Returns the files of the folder whose names begin with `begin` and end with ENDING.
    static std::vector<std::string> files(const std::string &folder, const std::string &begin)
    {
        std::vector<std::string> found;
        std::error_code problem;
        for (const auto &entry : std::filesystem::directory_iterator(folder, problem)) {
            const std::string name = entry.path().filename().string();
            const bool is_of_node = name.rfind(begin, 0) == 0 && // not of a node in its namespace
                                    name.find(ENDING) == name.find('.', begin.size());
            if (is_of_node && entry.path().extension() == ENDING)
                found.push_back(entry.path().string());
        }
        return found;
    }

    static bool is_empty(const std::string &path)
    {
        std::ifstream file(path);
        return file.is_open() && file.peek() == std::ifstream::traits_type::eof();
    }

    // Reads the names. Returns false if a name is not the name of a latched rule.
    static bool is_read(const std::string &path, std::set<std::string> &names)
    {
        std::ifstream file(path);
        bool is_good = file.is_open();
        for (std::string line; std::getline(file, line);) {
            is_good = is_good && is_latched(line);
            names.insert(line);
        }
        return is_good && !file.bad();
    }

    // Locks the file. The operating system releases the lock at any end of the node.
    void take()
    {
        const std::string beside = path_ + ".lock";
        lock_ = open(beside.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (lock_ < 0)
            refuse("cannot write " + beside + ": " + std::strerror(errno));
        if (flock(lock_, LOCK_EX | LOCK_NB) != 0)
            refuse(path_ + " is used by another node; each node needs its own file");
        std::FILE *file = std::fopen(new_path().c_str(), "w");
        if (file == nullptr)
            refuse("cannot write " + new_path() + ": " + std::strerror(errno));
        std::fclose(file);
        std::remove(new_path().c_str());
    }

    [[noreturn]] void refuse(const std::string &reason)
    {
        if (lock_ >= 0)
            close(std::exchange(lock_, -1));
        throw BadParameter("state_file", reason);
    }

    std::string new_path() const { return path_ + ".new"; }

    bool write_whole(const std::string &text) const
    {
        std::FILE *file = std::fopen(new_path().c_str(), "w");
        if (file == nullptr)
            return false;
        bool is_good = std::fputs(text.c_str(), file) >= 0 && std::fflush(file) == 0 &&
                       fsync(fileno(file)) == 0;
        is_good = std::fclose(file) == 0 && is_good;
        return is_good && std::rename(new_path().c_str(), path_.c_str()) == 0;
    }

    std::string path_;
    std::vector<std::string> relatives_; // files of this node, for any set of rules
    int lock_ = -1;
    std::string written_;
    bool has_written_ = false;
    bool is_kept_ = true;
};
