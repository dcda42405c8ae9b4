#include "input/scene/seabed/smooth_field.h"

#include "support/test.h"

using namespace sonarsim;

namespace {

PhiloxKey key_of(std::uint32_t number) {
    return bed_key(7, BedDraw::roughness, number);
}

}  // namespace

TEST_CASE("a smooth field has variance 1 and the correlation of its length") {
    const BedGrid grid{0.5, -80, 79, 160, 160};
    double sum = 0.0;
    double squares = 0.0;
    double along_x = 0.0;
    double along_y = 0.0;
    double count = 0.0;
    constexpr int lag = 4;  // two lengths: exp(-1)
    for (std::uint32_t n = 0; n < 16; ++n) {
        const std::vector<float> field = smooth_field(grid, 1.0, key_of(n));
        REQUIRE(field.size() == grid.size());
        for (int row = 0; row + lag < grid.rows; ++row) {
            for (int column = 0; column + lag < grid.columns; ++column) {
                const std::size_t i =
                    static_cast<std::size_t>(row) * 160 + static_cast<std::size_t>(column);
                const double x = field[i];
                sum += x;
                squares += x * x;
                along_x += x * field[i + lag];
                along_y += x * field[i + std::size_t{lag} * 160];
                count += 1.0;
            }
        }
    }
    // 4 deviations, each sqrt(4 pi / n) of n square lengths, 16 fields of 78^2.
    CHECK(std::abs(sum / count) < 0.046);
    CHECK(std::abs(squares / count - 1.0) < 0.046);
    CHECK(std::abs(along_x / count - std::exp(-1.0)) < 0.046);
    CHECK(std::abs(along_y / count - std::exp(-1.0)) < 0.046);
}

TEST_CASE("a smooth field far below the cells takes no finer lattice, and cells are independent") {
    const BedGrid grid{0.5, -80, 79, 160, 160};
    const std::vector<float> field = smooth_field(grid, 1e-300, key_of(5));
    CHECK(field == smooth_field(grid, 0.005, key_of(5)));
    double squares = 0.0;
    double neighbours = 0.0;
    for (std::size_t i = 0; i + 1 < field.size(); ++i) {
        squares += static_cast<double>(field[i]) * static_cast<double>(field[i]);
        neighbours += static_cast<double>(field[i]) * static_cast<double>(field[i + 1]);
    }
    // 4 deviations: sqrt(2 / n) of a variance, sqrt(1 / n) of a correlation, n = 25,600.
    const auto count = static_cast<double>(field.size());
    CHECK(std::abs(squares / count - 1.0) < 0.036);
    CHECK(std::abs(neighbours / count) < 0.025);
}
