// Reads clouds, one a line, and says which numbers of their points the node takes.
#include "clouds.h"

#include <cstdint>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

struct Field {
    std::string name;
    uint32_t offset = 0;
    uint8_t datatype = 0;
    uint32_t count = 0;
};

struct Cloud {
    uint32_t height = 0, width = 0;
    std::vector<Field> fields;
    uint8_t is_bigendian = 0;
    uint32_t point_step = 0, row_step = 0;
    std::vector<uint8_t> data;
};

static bool read(Cloud &cloud)
{
    std::size_t fields = 0, size = 0;
    unsigned number = 0;
    if (!(std::cin >> cloud.height >> cloud.width >> number >> cloud.point_step >> cloud.row_step >>
          fields))
        return false;
    cloud.is_bigendian = static_cast<uint8_t>(number);
    for (cloud.fields.resize(fields); auto &field : cloud.fields) {
        std::cin >> field.name >> field.offset >> number >> field.count;
        field.datatype = static_cast<uint8_t>(number);
    }
    std::cin >> size;
    for (cloud.data.resize(size); auto &byte : cloud.data) {
        std::cin >> number;
        byte = static_cast<uint8_t>(number);
    }
    return true;
}

int main()
{
    constexpr std::size_t MOST = 9;
    for (Cloud cloud; read(cloud); cloud = Cloud()) {
        // Of this very size, so that sanitizers see what is written behind it.
        std::vector<double> x(MOST), intensity(MOST), z(MOST);
        const std::size_t count = points(cloud, MOST,
                                         {
                                             {"x", x.data()},
                                             {"intensity", intensity.data()},
                                             {"z", z.data()},
                                         });
        std::printf("%zu", count);
        for (const auto &column : {x, intensity, z})
            for (std::size_t i = 0; i < count && count <= MOST; i++)
                std::printf(" %.17g", column[i]);
        std::puts("");
    }
    return 0;
}
