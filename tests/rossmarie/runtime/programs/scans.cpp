// Reads scans, one a line, and says which readings and beams of them the node takes.
#include "scans.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

struct Scan {
    float angle_min = 0, angle_max = 0, angle_increment = 0, range_min = 0, range_max = 0;
    std::vector<float> ranges, intensities;
};

static bool read(float &number)
{
    std::string text; // with `nan` and `inf`, which streams do not read
    if (!(std::cin >> text))
        return false;
    number = std::strtof(text.c_str(), nullptr);
    return true;
}

static bool read(std::vector<float> &numbers)
{
    std::size_t count = 0;
    std::cin >> count;
    for (numbers.resize(count); float &each : numbers)
        read(each);
    return true;
}

static void print(const std::vector<double> &numbers, std::size_t count)
{
    for (std::size_t i = 0; i < count && i < numbers.size(); i++)
        std::printf(" %.17g", numbers[i]);
}

int main()
{
    constexpr std::size_t MOST = 360;
    double first = 0, width = 0;
    std::vector<double> found;
    for (Scan scan; std::cin >> first >> width;) {
        for (float *each : {&scan.angle_min, &scan.angle_max, &scan.angle_increment,
                            &scan.range_min, &scan.range_max})
            read(*each);
        read(scan.ranges);
        read(scan.intensities);
        sector(scan, first, width, found);
        std::printf("%zu", found.size());
        print(found, found.size());
        // Of this very size, so that sanitizers see what is written behind it.
        std::vector<double> range(MOST), angle(MOST), intensity(MOST), invalid(MOST);
        const std::size_t points = beams(scan, true, MOST,
                                         {
                                             {BeamField::RANGE, range.data()},
                                             {BeamField::ANGLE, angle.data()},
                                             {BeamField::INTENSITY, intensity.data()},
                                         });
        std::printf(" %zu", points);
        for (const auto &column : {range, angle, intensity})
            print(column, points == scans::UNKNOWN ? 0 : points);
        const std::size_t others = beams(scan, false, MOST, {{BeamField::ANGLE, invalid.data()}});
        std::printf(" %zu", others);
        print(invalid, others == scans::UNKNOWN ? 0 : others);
        std::puts("");
    }
    return 0;
}
