// Fields become numbers, numbers become fields, and stamps are found where there are any.
#include "messages.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "check.h"
#include "stamps.h"

const std::vector<std::string> TEXTS = {"docking", "idle"};

struct Bare {
    int data = 0;
};
struct Stamped {
    struct {
        Middleware::Time stamp;
    } header;
};

int main()
{
    CHECK(number(true) == 1.0);
    CHECK(number(uint8_t{200}) == 200.0);
    CHECK(number(Middleware::time(1'500'000'000)) == 1.5);
    CHECK(numbers(std::vector<float>{0.5F, 2.0F}) == std::vector<double>({0.5, 2.0}));
    std::array<double, 2> room{};
    const auto half = [](int each) { return each / 2.0; };
    CHECK(column(std::vector<int>{1, 2}, room, half) == room.data());
    CHECK(room == (std::array<double, 2>{0.5, 1.0}));
    column(std::vector<int>{4, 5, 6}, room, half); // a list that is too long leaves the rest alone
    CHECK(room == (std::array<double, 2>{2.0, 2.5}));
    CHECK(element(std::array<double, 2>{1.0, 2.0}, 1) == 2.0);
    CHECK(std::isnan(element(std::vector<double>{1.0}, 1)));
    CHECK(text_index("idle") == 1.0);
    CHECK(text_index("IDLE") == -1.0);

    int8_t small = 0;
    assign(small, -3.0);
    CHECK(small == -3);
    Middleware::Duration time;
    assign(time, 0.25);
    CHECK(time.ns == 250'000'000);
    std::vector<float> many;
    assign(many, {1.0, 2.0, 3.0});
    CHECK(many == std::vector<float>({1.0F, 2.0F, 3.0F}));
    std::array<double, 2> fixed{};
    assign(fixed, {1.0, 2.0});
    CHECK(fixed[1] == 2.0);

    static_assert(has_stamp<Stamped>() && !has_stamp<Bare>());
    Stamped stamped;
    put_stamp(stamped, Middleware::time(7));
    CHECK(stamped.header.stamp.ns == 7);
    Bare bare;
    put_stamp(bare, Middleware::time(7));
    CHECK(bare.data == 0);
    return result();
}
