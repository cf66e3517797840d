// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// Answers of the skills that run to the questions of the rules. Nothing in a message is trusted:
// where it is from another export, or too large, nobody knows the answer, which is NAN.
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

// A parameter, and the classes of which its argument has to have one.
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

template <class Context> bool is_readable(const Context &context, const char *digest)
{
    if (context.digest != digest || context.running.size() > MOST)
        return false;
    for (const auto &skill : context.running) {
        if (skill.arguments.size() > MOST)
            return false;
        for (const auto &argument : skill.arguments)
            if (argument.properties.size() > MOST)
                return false;
    }
    return true;
}

// The argument of a parameter, or null; `count` is how many there are of it.
template <class Skill>
auto argument_of(const Skill &skill, const char *parameter, std::size_t &count)
{
    const typename decltype(skill.arguments)::value_type *found = nullptr;
    count = 0;
    for (const auto &argument : skill.arguments) {
        if (argument.parameter != parameter)
            continue;
        found = &argument;
        count++;
    }
    return found;
}

// Whether the argument of a skill is of a class; `is_known` becomes false if there are several.
template <class Skill, std::size_t COUNT>
bool is_within(const Skill &skill, const Limit<COUNT> &limit, bool &is_known)
{
    std::size_t count = 0;
    const auto *argument = argument_of(skill, limit.parameter, count);
    is_known = is_known && count < 2;
    return argument != nullptr && has(limit.classes, argument->type);
}

// 1 if a running skill is one of `asked`, and its arguments are within all limits, 0 if none is.
template <class Context, class Asked, class... Limits>
double doing(const Context &context, const char *digest, const Asked &asked,
             const Limits &...limits)
{
    if (!is_readable(context, digest))
        return NAN;
    bool is_known = true, is_done = false;
    for (const auto &skill : context.running) {
        if (!has(asked, skill.skill))
            continue;
        bool is_within_all = true;
        ((is_within_all = is_within(skill, limits, is_known) && is_within_all), ...);
        is_done = is_done || is_within_all;
    }
    if (!is_known)
        return NAN;
    return is_done ? 1.0 : 0.0;
}

// The only running skill that is one of `asked`; null if none is, or several are.
template <class Context, class Asked> auto only(const Context &context, const Asked &asked)
{
    const typename decltype(context.running)::value_type *found = nullptr;
    for (const auto &skill : context.running) {
        if (!has(asked, skill.skill))
            continue;
        if (found != nullptr)
            return decltype(found){nullptr};
        found = &skill;
    }
    return found;
}

// The argument of the only running skill that is one of `asked`, if it is there once.
template <class Context, class Asked>
auto only_argument(const Context &context, const char *digest, const Asked &asked,
                   const char *parameter)
{
    const auto *skill = is_readable(context, digest) ? only(context, asked) : nullptr;
    std::size_t count = 0;
    const auto *argument = skill == nullptr ? nullptr : argument_of(*skill, parameter, count);
    return count == 1 ? argument : nullptr;
}

// The number that is an argument of the only running skill that is one of `asked`.
template <class Context, class Asked>
double quantity(const Context &context, const char *digest, const Asked &asked,
                const char *parameter)
{
    const auto *argument = only_argument(context, digest, asked, parameter);
    return argument == nullptr ? NAN : argument->number;
}

// The same of a property of the thing that is the argument.
template <class Context, class Asked>
double quantity(const Context &context, const char *digest, const Asked &asked,
                const char *parameter, const char *property)
{
    const auto *argument = only_argument(context, digest, asked, parameter);
    if (argument == nullptr)
        return NAN;
    double number = NAN;
    std::size_t count = 0;
    for (const auto &each : argument->properties) {
        if (each.property != property)
            continue;
        number = each.number;
        count++;
    }
    return count == 1 ? number : NAN;
}

} // namespace skills
