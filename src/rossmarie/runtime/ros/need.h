// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// The requirements of the node on other nodes.
#pragma once

#include <map>
#include <string>

// A service, or a topic, with its type if the type matters. `title` is its name for users.
struct Need {
    std::string title;
    std::string name;
    std::string type;
    bool is_service = false;
    bool is_optional = false; // no node has to offer it
};

// The results of the check of other nodes.
struct Findings {
    std::map<std::string, std::string> problems; // missing requirements, by title, with the problem
    std::map<std::string, std::string> bypassed; // command topics, with their other publishers
};
