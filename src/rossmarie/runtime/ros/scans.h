// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Reads sectors, points and beams without a reading from a laser scan. A scan describes the angles
// of its beams. This code checks the description before each use. Compile with -ffp-contract=off,
// so that the angles equal the angles of a replay to the last bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// A field of beams that the rules read, and memory for its numbers.
enum class BeamField { RANGE, ANGLE, INTENSITY };
struct BeamColumn {
    BeamField field;
    double *room;
};

namespace scans {

constexpr std::size_t UNKNOWN = SIZE_MAX; // greater than the size of any list
constexpr double HALF_TURN = 3.141592653589793, TURN = 2.0 * HALF_TURN;
constexpr double SLACK = 0.01;   // tolerance of an angle, in increments
constexpr double MISCOUNT = 1.5; // tolerance of `angle_max`, in increments

enum class Reading { RETURN, CLOSE, NOTHING, INVALID };

// The numbers of a scan that describe its readings.
struct Frame {
    double first, increment, step, low, high;
    std::size_t count;

    double angle(std::size_t beam) const { return first + static_cast<double>(beam) * increment; }

    Reading reading(double range) const
    {
        if (range > high || range == INFINITY)
            return Reading::NOTHING;
        if (range >= low)
            return Reading::RETURN;
        return range == -INFINITY ? Reading::CLOSE : Reading::INVALID;
    }
};

template <class Scan> Frame frame_of(const Scan &scan)
{
    Frame frame{};
    frame.first = static_cast<double>(scan.angle_min);
    frame.increment = static_cast<double>(scan.angle_increment);
    frame.step = std::fabs(frame.increment);
    frame.low = static_cast<double>(scan.range_min);
    frame.high = static_cast<double>(scan.range_max);
    frame.count = scan.ranges.size();
    return frame;
}

// Returns true if a scan is consistent.
template <class Scan> bool is_sound(const Scan &scan, const Frame &frame)
{
    const double last = static_cast<double>(scan.angle_max);
    if (frame.count == 0)
        return false;
    if (!std::isfinite(frame.first) || !std::isfinite(last) || !std::isfinite(frame.increment))
        return false;
    if (frame.count > 1 && !(frame.step > 0.0 && frame.step <= HALF_TURN / 2.0))
        return false;
    const double reach = frame.increment * static_cast<double>(frame.count - 1);
    if (std::fabs((last - frame.first) - reach) > MISCOUNT * frame.step)
        return false;
    return 0.0 <= frame.low && frame.low <= frame.high && 0.0 < frame.high && frame.low < INFINITY;
}

// Returns an angle modulo a turn, in [0, TURN).
inline double within_turn(double angle) { return angle - std::floor(angle / TURN) * TURN; }

// Returns true if the beams cover a sector, with a tolerance of one increment at each end.
inline bool reaches_over(const Frame &frame, double first, double width)
{
    const double last = static_cast<double>(frame.count - 1);
    const double span = frame.step * last, step = (1.0 + SLACK) * frame.step;
    if (span + step >= TURN)
        return true;
    const double least = std::min(frame.first, frame.first + last * frame.increment);
    const double ahead = within_turn((first - least) + step);
    return (ahead - step) + width <= span + step;
}

} // namespace scans

// Fills `found` with the valid readings of a sector. Leaves it empty if the scan is unknown.
template <class Scan>
void sector(const Scan &scan, double first, double width, std::vector<double> &found)
{
    using scans::Reading;
    const scans::Frame frame = scans::frame_of(scan);
    found.clear();
    if (!scans::is_sound(scan, frame) || !scans::reaches_over(frame, first, width))
        return;
    const double slack = scans::SLACK * frame.step;
    for (std::size_t beam = 0; beam != frame.count; beam++) {
        const double ahead = scans::within_turn(frame.angle(beam) - first);
        if (ahead > width + slack && ahead < scans::TURN - slack)
            continue;
        const double range = static_cast<double>(scan.ranges[beam]);
        const Reading reading = frame.reading(range);
        if (reading != Reading::INVALID)
            found.push_back(reading == Reading::NOTHING ? INFINITY : range);
    }
}

// Fills the columns with the points of a scan, or with the beams without a reading, and returns
// their number. Returns UNKNOWN if the scan has more than `most` beams, or if the scan is unknown.
template <class Scan, std::size_t COLUMNS>
std::size_t beams(const Scan &scan, bool are_points, std::size_t most,
                  const BeamColumn (&columns)[COLUMNS])
{
    using scans::Reading;
    const scans::Frame frame = scans::frame_of(scan);
    if (!scans::is_sound(scan, frame) || frame.count > most)
        return scans::UNKNOWN;
    for (const BeamColumn &column : columns)
        if (column.field == BeamField::INTENSITY && scan.intensities.size() != frame.count)
            return scans::UNKNOWN;
    std::size_t count = 0;
    for (std::size_t beam = 0; beam != frame.count; beam++) {
        const double range = static_cast<double>(scan.ranges[beam]);
        const Reading reading = frame.reading(range);
        const bool is_point = reading == Reading::RETURN || reading == Reading::CLOSE;
        if (are_points ? !is_point : reading != Reading::INVALID)
            continue;
        for (const BeamColumn &column : columns) {
            double &place = column.room[count];
            switch (column.field) {
            case BeamField::RANGE:
                place = reading == Reading::CLOSE ? NAN : range;
                break;
            case BeamField::ANGLE: {
                const double angle = frame.angle(beam);
                place = angle - std::floor((angle + scans::HALF_TURN) / scans::TURN) * scans::TURN;
                break;
            }
            case BeamField::INTENSITY:
                place = static_cast<double>(scan.intensities[beam]);
                break;
            }
        }
        count++;
    }
    return count;
}
