// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Conversions between message fields and numbers.
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

// Returns all elements of an array.
template <class Array> std::vector<double> numbers(const Array &array)
{
    std::vector<double> numbers;
    numbers.reserve(array.size());
    for (const auto &element : array)
        numbers.push_back(number(element));
    return numbers;
}

// Copies one field of each element of a list until `room` is full. The rules use only the length of
// a longer list.
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

// Returns an element of an array. The element is NAN (unknown) if the array is shorter.
template <class Array> double element(const Array &array, std::size_t index)
{
    return index < array.size() ? number(array[index]) : NAN;
}

// Returns the index of the element with a name. Returns SIZE_MAX if no element or several elements
// have this name, or if the arrays of names and of elements differ in length.
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

// Returns `place` if the array has `count` elements, and SIZE_MAX otherwise.
template <class Array>
std::size_t place_among(std::size_t place, std::size_t count, const Array &array)
{
    return array.size() == count ? place : SIZE_MAX;
}

// Returns the index of a text in TEXTS, or -1 for any other text.
inline double text_index(const std::string &text)
{
    const auto found = std::find(TEXTS.begin(), TEXTS.end(), text);
    return found == TEXTS.end() ? -1.0 : static_cast<double>(found - TEXTS.begin());
}

// True if the size of an array type is not fixed.
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
