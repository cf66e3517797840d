// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Answers the queries of the rules about the running skills. The answer is NAN (unknown) if the
// message belongs to another export or is too large.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace skills {

constexpr std::size_t MOST = 64; // skills, arguments of a skill, and properties of an argument

template <std::size_t COUNT> using Names = std::array<const char *, COUNT>;

template <class... Texts> constexpr Names<sizeof...(Texts)> names(Texts... texts)
{
    return {texts...};
}

// A parameter, and the allowed classes of its argument.
template <std::size_t COUNT> struct Limit {
    const char *parameter;
    Names<COUNT> classes;
};

template <class... Texts>
constexpr Limit<sizeof...(Texts)> limit(const char *parameter, Texts... classes)
{
    return {parameter, names(classes...)};
}

template <std::size_t COUNT> bool has(const Names<COUNT> &names, const std::string &wanted)
{
    for (const char *name : names)
        if (wanted == name)
            return true;
    return false;
}

template <class Skills> bool are_readable(const Skills &skills)
{
    if (skills.size() > MOST)
        return false;
    for (const auto &skill : skills) {
        if (skill.arguments.size() > MOST)
            return false;
        for (const auto &argument : skill.arguments)
            if (argument.properties.size() > MOST)
                return false;
    }
    return true;
}

template <class Context> bool is_readable(const Context &context, const char *digest)
{
    return context.digest == digest && are_readable(context.running) && are_readable(context.ahead);
}

// Returns true if an argument of a skill has one of the classes. An individual with several classes
// occurs once for each class.
template <class Skill, std::size_t COUNT>
bool is_within(const Skill &skill, const Limit<COUNT> &limit)
{
    for (const auto &argument : skill.arguments)
        if (argument.parameter == limit.parameter && has(limit.classes, argument.type))
            return true;
    return false;
}

// Returns 1 if a running skill is one of `asked` and its arguments are within all limits, else 0.
template <class Context, class Asked, class... Limits>
double doing(const Context &context, const char *digest, const Asked &asked,
             const Limits &...limits)
{
    if (!is_readable(context, digest))
        return NAN;
    for (const auto &skill : context.running)
        if (has(asked, skill.skill) && (is_within(skill, limits) && ...))
            return 1.0;
    return 0.0;
}

// Returns true if a skill that can start next has no argument for this parameter yet.
template <class Skill, std::size_t COUNT>
bool is_open(const Skill &skill, const Limit<COUNT> &limit)
{
    for (const auto &argument : skill.arguments)
        if (argument.parameter == limit.parameter)
            return false;
    return true;
}

// Returns 1 if a skill that can start next is one of `asked` and its arguments may be within all
// limits, else 0.
template <class Context, class Asked, class... Limits>
double ahead(const Context &context, const char *digest, const Asked &asked,
             const Limits &...limits)
{
    if (!is_readable(context, digest) || !context.is_ahead_known)
        return NAN;
    for (const auto &skill : context.ahead)
        if (has(asked, skill.skill) &&
            ((is_open(skill, limits) || is_within(skill, limits)) && ...))
            return 1.0;
    return 0.0;
}

// A number that must occur at least once, and always with the same value.
class OnlyNumber {
public:
    void add(double number)
    {
        is_one_ = is_one_ && (!is_there_ || number == number_);
        number_ = is_there_ ? number_ : number;
        is_there_ = true;
    }
    double get() const { return is_there_ && is_one_ ? number_ : NAN; }

private:
    double number_ = NAN;
    bool is_there_ = false, is_one_ = true;
};

// Calls `visit` with each argument of a parameter of the running skill that is one of `asked`. Does
// nothing unless exactly one such skill runs.
template <class Context, class Asked, class Visit>
void each_argument(const Context &context, const char *digest, const Asked &asked,
                   const char *parameter, Visit visit)
{
    const typename decltype(context.running)::value_type *found = nullptr;
    if (!is_readable(context, digest))
        return;
    for (const auto &skill : context.running) {
        if (!has(asked, skill.skill))
            continue;
        if (found != nullptr)
            return;
        found = &skill;
    }
    if (found == nullptr)
        return;
    for (const auto &argument : found->arguments)
        if (argument.parameter == parameter)
            visit(argument);
}

// Returns the numeric argument of the only running skill that is one of `asked`.
template <class Context, class Asked>
double quantity(const Context &context, const char *digest, const Asked &asked,
                const char *parameter)
{
    OnlyNumber number;
    each_argument(context, digest, asked, parameter,
                  [&number](const auto &argument) { number.add(argument.number); });
    return number.get();
}

// Returns a property of the individual that is the argument of this skill.
template <class Context, class Asked>
double quantity(const Context &context, const char *digest, const Asked &asked,
                const char *parameter, const char *property)
{
    OnlyNumber number;
    each_argument(context, digest, asked, parameter, [&number, property](const auto &argument) {
        for (const auto &each : argument.properties)
            if (each.property == property)
                number.add(each.number);
    });
    return number.get();
}

// Returns the number of a boolean. A boolean is 0 or 1; any other number is unknown.
inline double boolean(double number) { return number == 0.0 || number == 1.0 ? number : NAN; }

} // namespace skills
