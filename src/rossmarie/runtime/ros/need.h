// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// What the node needs of others.
#pragma once

#include <map>
#include <string>

// A service, or a topic: then of a type, if it matters. `title` is what people call it.
struct Need {
    std::string title;
    std::string name;
    std::string type;
    bool is_service = false;
    bool is_optional = false; // nobody has to offer it
};

// What the node finds out of others.
struct Findings {
    std::map<std::string, std::string> problems; // what is missing, by title, and how
    std::map<std::string, std::string> bypassed; // command topics, and who else publishes them
};
