// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// Fields of messages as numbers, and numbers as fields.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "descriptions.h"
#include "middleware.h"

template <class Number> double number(Number value) { return static_cast<double>(value); }
inline double number(const Middleware::Time &time) { return Middleware::seconds(time); }
inline double number(const Middleware::Duration &duration) { return Middleware::seconds(duration); }

// All elements of an array.
template <class Array> std::vector<double> numbers(const Array &array)
{
    std::vector<double> numbers;
    numbers.reserve(array.size());
    for (const auto &element : array)
        numbers.push_back(number(element));
    return numbers;
}

// One field of all elements of a list, as far as there is room: of a longer list only its length
// counts.
template <class List, std::size_t MOST, class Read>
const double *column(const List &list, std::array<double, MOST> &room, Read read)
{
    std::size_t place = 0;
    for (const auto &element : list) {
        if (place == MOST)
            break;
        room[place++] = read(element);
    }
    return room.data();
}

// An element of an array that may be shorter; then it is unknown.
template <class Array> double element(const Array &array, std::size_t index)
{
    return index < array.size() ? number(array[index]) : NAN;
}

// The place of an element by its name, the place behind all others if none has it, or several have,
// or if nobody knows which names belong to which elements.
template <class Names, class Array>
std::size_t place_of(const char *name, const Names &names, const Array &array)
{
    if (names.size() != array.size())
        return SIZE_MAX;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end() || std::find(found + 1, names.end(), name) != names.end())
        return SIZE_MAX;
    return static_cast<std::size_t>(found - names.begin());
}

// The place of an element in an array that has to have `count`, else the place behind all others.
template <class Array>
std::size_t place_among(std::size_t place, std::size_t count, const Array &array)
{
    return array.size() == count ? place : SIZE_MAX;
}

// The index of a text among those that the rules know, -1 for any other.
inline double text_index(const std::string &text)
{
    const auto found = std::find(TEXTS.begin(), TEXTS.end(), text);
    return found == TEXTS.end() ? -1.0 : static_cast<double>(found - TEXTS.begin());
}

// True if an array is as long as it is said to be, not of a fixed size.
template <class Array>
constexpr auto is_resizable(int) -> decltype(std::declval<Array>().resize(1), true)
{
    return true;
}
template <class Array> constexpr bool is_resizable(long) { return false; }

template <class Field> void assign(Field &field, double value)
{
    field = static_cast<Field>(value);
}
inline void assign(Middleware::Time &field, double value)
{
    field = Middleware::time(static_cast<int64_t>(value * 1e9));
}
inline void assign(Middleware::Duration &field, double value)
{
    field = Middleware::duration(static_cast<int64_t>(value * 1e9));
}

template <class Array> void assign(Array &field, std::initializer_list<double> values)
{
    using Element = typename Array::value_type;
    if constexpr (is_resizable<Array>(0))
        field.resize(values.size());
    std::transform(values.begin(), values.end(), field.begin(),
                   [](double value) { return static_cast<Element>(value); });
}
