// Reads contexts, one a line, and says what their skills answer to the queries of a node.
#include "skills.h"

#include <cstdio>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

struct Property {
    std::string property;
    double number = 0.0;
};

struct Argument {
    std::string parameter, type;
    double number = 0.0;
    std::vector<Property> properties;
};

struct Skill {
    std::string skill;
    std::vector<Argument> arguments;
};

struct Context {
    std::string digest;
    std::vector<Skill> running, ahead;
    bool is_ahead_known = false;
};

template <class Element> static void resize(std::vector<Element> &elements)
{
    std::size_t count = 0;
    std::cin >> count;
    elements.resize(count);
}

static double number()
{
    std::string text;
    std::cin >> text;
    return std::stod(text);
}

static void read(std::vector<Skill> &skills)
{
    resize(skills);
    for (auto &skill : skills) {
        std::cin >> std::quoted(skill.skill);
        resize(skill.arguments);
        for (auto &argument : skill.arguments) {
            std::cin >> std::quoted(argument.parameter) >> std::quoted(argument.type);
            argument.number = number();
            resize(argument.properties);
            for (auto &property : argument.properties) {
                std::cin >> std::quoted(property.property);
                property.number = number();
            }
        }
    }
}

static bool read(Context &context)
{
    if (!(std::cin >> std::quoted(context.digest) >> context.is_ahead_known))
        return false;
    read(context.running);
    read(context.ahead);
    return true;
}

static std::vector<double> answers(const Context &message)
{
    return {
#include "queries.inc"
    };
}

int main()
{
    for (Context context; read(context); context = Context()) {
        for (const double answer : answers(context))
            std::printf("%.17g ", answer);
        std::puts("");
    }
    return 0;
}
