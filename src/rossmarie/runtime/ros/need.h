// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// The requirements of this node on other nodes.
#pragma once

#include <map>
#include <string>

// A service, or a topic with its type if the type matters. `title` is its name in diagnostics.
struct Need {
    std::string title;
    std::string name;
    std::string type;
    bool is_service = false;
    bool is_optional = false; // true: the service or topic may be absent
};

// The results of the check of other nodes.
struct Findings {
    std::map<std::string, std::string> problems; // the problem of each unmet requirement, by title
    std::map<std::string, std::string>
        bypassed; // the other publisher of each bypassed command topic
};
