// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// Answers of the running skills to the queries of the rules. Messages are not trusted: if a message
// comes from another export, or is too large, the answer is NAN (unknown).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace skills {

constexpr std::size_t MOST = 64; // skills, arguments of each, and properties of each of these

template <std::size_t COUNT> using Names = std::array<const char *, COUNT>;

template <class... Texts> constexpr Names<sizeof...(Texts)> names(Texts... texts)
{
    return {texts...};
}

// A parameter, and the classes of its argument: it has to have one of them.
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

// True if an argument of a skill is of a class. An individual of several classes occurs once for
// each.
template <class Skill, std::size_t COUNT>
bool is_within(const Skill &skill, const Limit<COUNT> &limit)
{
    for (const auto &argument : skill.arguments)
        if (argument.parameter == limit.parameter && has(limit.classes, argument.type))
            return true;
    return false;
}

// 1 if a running skill is one of `asked`, and its arguments are within all limits; 0 if none is.
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

// True if the argument of a parameter of a skill that can start next is still unknown.
template <class Skill, std::size_t COUNT>
bool is_open(const Skill &skill, const Limit<COUNT> &limit)
{
    for (const auto &argument : skill.arguments)
        if (argument.parameter == limit.parameter)
            return false;
    return true;
}

// 1 if a skill that can start next is one of `asked`, and its arguments may be within all limits; 0
// if none is.
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

// A number that occurs at least once, always with the same value.
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

// Calls a function with each argument of a parameter of the skill that is one of `asked`, if only
// one such skill runs.
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

// The number that is an argument of the only running skill that is one of `asked`.
template <class Context, class Asked>
double quantity(const Context &context, const char *digest, const Asked &asked,
                const char *parameter)
{
    OnlyNumber number;
    each_argument(context, digest, asked, parameter,
                  [&number](const auto &argument) { number.add(argument.number); });
    return number.get();
}

// The same of a property of the individual that is the argument.
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

// The number of a boolean, which is 0 or 1.
inline double boolean(double number) { return number == 0.0 || number == 1.0 ? number : NAN; }

} // namespace skills
