// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Reads the points of a cloud from its bytes into columns of numbers. A cloud describes the offsets
// of its numbers. This code checks the description before each use.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// A field of points that the rules read, and memory for its numbers.
struct PointColumn {
    const char *name;
    double *room;
};

namespace clouds {

constexpr std::size_t UNKNOWN = SIZE_MAX; // greater than the size of any list
constexpr std::array<const char *, 3> AXES{"x", "y", "z"};
constexpr std::array<std::size_t, 9> SIZES{0, 1, 1, 2, 2,
                                           4, 4, 4, 8}; // in bytes, indexed by the type; INT8 is 1

// The offset of a number in the bytes of a point, and its type. Type 0 means that it is no number.
struct Place {
    std::size_t offset = 0;
    std::size_t type = 0;
};

template <class Number, class Bits> double as(std::uint64_t bits)
{
    static_assert(sizeof(Number) == sizeof(Bits), "the same bits");
    const auto part = static_cast<Bits>(bits);
    Number number;
    std::memcpy(&number, &part, sizeof number);
    return static_cast<double>(number);
}

inline double number_at(const std::uint8_t *bytes, std::size_t type, bool is_big)
{
    std::uint64_t bits = 0;
    const std::size_t size = SIZES[type];
    for (std::size_t i = 0; i != size; i++)
        bits = bits << 8U | bytes[is_big ? i : size - 1 - i];
    switch (type) {
    case 1:
        return as<std::int8_t, std::uint8_t>(bits);
    case 2:
        return as<std::uint8_t, std::uint8_t>(bits);
    case 3:
        return as<std::int16_t, std::uint16_t>(bits);
    case 4:
        return as<std::uint16_t, std::uint16_t>(bits);
    case 5:
        return as<std::int32_t, std::uint32_t>(bits);
    case 6:
        return as<std::uint32_t, std::uint32_t>(bits);
    case 7:
        return as<float, std::uint32_t>(bits);
    default:
        return as<double, std::uint64_t>(bits);
    }
}

// Returns the number of fields with this name. `place` is the place of the last of these fields if
// the field is a single number.
template <class Cloud> std::size_t find(const Cloud &cloud, const char *name, Place &place)
{
    std::size_t found = 0;
    for (const auto &field : cloud.fields) {
        if (field.name != name)
            continue;
        found++;
        place = Place{};
        const std::size_t type = field.datatype;
        if (type == 0 || type >= SIZES.size() ||
            field.count > 1) // PCL writes 0 for a single number
            continue;
        if (std::uint64_t{field.offset} + SIZES[type] <= cloud.point_step)
            place = {field.offset, type};
    }
    return found;
}

// Returns true if all points lie inside the data and do not overlap.
template <class Cloud> bool is_whole(const Cloud &cloud, std::size_t most)
{
    const std::uint64_t rows = cloud.height, columns = cloud.width;
    if (rows == 0 || columns == 0)
        return true;
    if (rows > most / columns)
        return false;
    const std::uint64_t row = columns * cloud.point_step; // below 2^64, like the products below
    if (rows > 1 && cloud.row_step < row)
        return false;
    return (rows - 1) * cloud.row_step + row <= cloud.data.size();
}

} // namespace clouds

// Fills the columns with the points that have a position, and returns the number of these points.
// Returns UNKNOWN if the cloud has more than `most` points, including points without a position, or
// if the cloud is not readable.
template <class Cloud, std::size_t COLUMNS>
std::size_t points(const Cloud &cloud, std::size_t most, const PointColumn (&columns)[COLUMNS])
{
    std::array<clouds::Place, COLUMNS> places{};
    for (std::size_t i = 0; i != COLUMNS; i++)
        if (clouds::find(cloud, columns[i].name, places[i]) != 1 || places[i].type == 0)
            return clouds::UNKNOWN;
    std::array<clouds::Place, clouds::AXES.size()> axes{};
    for (std::size_t i = 0; i != axes.size(); i++) {
        const std::size_t found = clouds::find(cloud, clouds::AXES[i], axes[i]);
        if (found > 1 || (found == 1 && axes[i].type == 0))
            return clouds::UNKNOWN;
    }
    if (!clouds::is_whole(cloud, most))
        return clouds::UNKNOWN;
    if (cloud.width == 0) // the cloud may have any number of empty rows
        return 0;
    std::size_t count = 0;
    for (std::size_t row = 0; row != cloud.height; row++) {
        for (std::size_t column = 0; column != cloud.width; column++) {
            const std::uint8_t *point =
                cloud.data.data() + row * cloud.row_step + column * cloud.point_step;
            const auto number = [&cloud, point](const clouds::Place &place) {
                return clouds::number_at(point + place.offset, place.type, cloud.is_bigendian);
            };
            bool is_there = true;
            for (const clouds::Place &axis : axes)
                is_there = is_there && (axis.type == 0 || !std::isnan(number(axis)));
            if (!is_there)
                continue;
            for (std::size_t i = 0; i != COLUMNS; i++)
                columns[i].room[count] = number(places[i]);
            count++;
        }
    }
    return count;
}
