// Runs the rules over a trace: `./run trace.csv`. Do not change this file.
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "rover.hpp"

int main(int argc, char **argv) {
    if (argc != 2) return 2;
    std::ifstream opened(argv[1]);
    std::string line;
    std::getline(opened, line);  // time, four of the quaternion, speed, distance, wanted
    Guard guard;
    while (std::getline(opened, line)) {
        std::vector<std::string> cells;
        std::istringstream rest(line);
        for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
        cells.resize(8);
        double now = std::stod(cells[0]);
        if (!cells[1].empty())
            guard.on_imu(now, {{std::stod(cells[1]), std::stod(cells[2]), std::stod(cells[3]),
                                std::stod(cells[4])}});
        if (!cells[5].empty()) guard.on_odometry(now, {{{{std::stod(cells[5]), 0, 0}}}});
        if (!cells[6].empty()) guard.on_front(now, {std::stod(cells[6])});
        std::printf("%.1f %.2f\n", now, guard.command(now, std::stod(cells[7])));
    }
}
