#include "simulate/trace/taper.h"

#include "simulate/calibrated/speckle/scatterers.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/patches.h"

namespace {

constexpr double nearest_m = 8.0;
constexpr double farthest_m = 10.4;
constexpr double below_m = 2.0;  // the floor
constexpr int columns = 60;
const double column_rad = radians(0.5);

/// The footprint on the floor between two azimuths and two distances.
Sample footprint(int column, double from_m, double to_m) {
    const double azimuth = (column + 0.5 - 0.5 * columns) * column_rad;
    const double middle = 0.5 * (from_m + to_m);
    const double half_width = middle * std::tan(0.5 * column_rad);
    const double half_length = 0.5 * (to_m - from_m);
    const Eigen::Vector3d ahead(std::cos(azimuth), std::sin(azimuth), 0.0);
    const Eigen::Vector3d across(-std::sin(azimuth), std::cos(azimuth), 0.0);
    return patch_of((middle * ahead - Eigen::Vector3d(0.0, 0.0, below_m)).cast<float>(),
                    {0.0F, 0.0F, 1.0F}, (half_width * across).cast<float>(),
                    (half_length * ahead).cast<float>());
}

/// The floor in `parts` footprints along each column.
std::vector<Sample> floor_in(int parts) {
    std::vector<Sample> out;
    for (int column = 0; column < columns; ++column) {
        for (int k = 0; k < parts; ++k) {
            const auto at = [&](int n) {
                return std::lerp(nearest_m, farthest_m, 1.0 * n / parts);
            };
            out.push_back(footprint(column, at(k), at(k + 1)));
        }
    }
    return out;
}

/// Calls `use(block, number)` for each scatterer on a surface, in cells of one size.
template <class Use>
void for_each_scatterer(const std::vector<Sample>& surface, Use use) {
    const ScattererCells cells{.min_edge_m = 0.02F,
                               .edge_per_root_range = 0.01F,
                               .max_depth_m = 0.02F,
                               .width_rad = 0.001F};
    Scatterers block;
    find_scatterers(surface, ViewShape::fan, cells, {}, {1, 2}, block,
                    [&](const Scatterers& found) {
                        for (int k = 0; k < found.pieces.count; ++k)
                            use(found, k);
                    });
}

std::map<std::array<std::int32_t, 3>, int> cells_on(const std::vector<Sample>& surface) {
    std::map<std::array<std::int32_t, 3>, int> out;
    for_each_scatterer(surface, [&](const Scatterers& found, int k) {
        ++out[{found.cell[0][k], found.cell[1][k], found.cell[2][k]}];
    });
    return out;
}

}  // namespace

// Along edge_v the distance from the vertical axis grows by 2.4 m / 9.2 m of its mean.
TEST_CASE("taper: a footprint widens with the distance from the axis of its angles") {
    const Sample sample = footprint(0, nearest_m, farthest_m);
    CHECK(taper_of(sample, ViewShape::fan).v == approx(1.2 / 9.2).epsilon(1e-5));
    CHECK(std::fabs(taper_of(sample, ViewShape::fan).u) < 1e-6F);
    CHECK(taper_of(sample, {}).v == 0.0F);
    // Below the sonar it has no width on the axis, and no negative one beyond.
    Sample below = footprint(columns / 2, -1.0, 2.0);
    CHECK(taper_of(below, ViewShape::fan).v == approx(1.0));
    below.position.head<2>().setZero();
    CHECK(taper_of(below, ViewShape::fan).v == 0.0F);
    // Ranges of 8.2 and 10.6 m: in strips between latitudes the width grows with the range.
    const double range2 = 9.2 * 9.2 + below_m * below_m;
    CHECK(taper_of(sample, ViewShape::port_starboard).v ==
          approx(9.2 * 1.2 / range2).epsilon(1e-5));
}

// Without the taper the first bins would be 15 % too bright and the last 12 % too dark.
TEST_CASE("taper: long footprints give the image of short ones") {
    InstrumentConfig config = bare({});
    config.frequency_hz = 7e5;
    config.beam.width_deg = 1.0;
    const View view{columns * column_rad, 1.0, 7.0, 12.0, 100, columns};
    const BeamSines sines = fan_sines(0.5 * columns, columns);
    const CalibratedModel model =
        calibrated_model(config, {}, view, {.middles = sines.middles, .edges = {}});
    const auto image_of = [&](int parts) {
        Samples samples;
        samples.items = floor_in(parts);
        return image_of_samples(model, view, samples, {});
    };
    const std::vector<float> exact = image_of(24);
    const std::vector<float> coarse = image_of(1);
    for (int row = 28; row < 68; ++row) {  // 8.4 to 10.4 m, within the floor
        CAPTURE(row);
        const auto sum = [&](const std::vector<float>& image) {
            return total(std::span(image).subspan(row * columns + 10, columns - 20));
        };
        CHECK(sum(coarse) == approx(sum(exact)).epsilon(0.01));
    }
}

TEST_CASE("taper: long footprints hold the scatterers of short ones, each once") {
    const auto exact = cells_on(floor_in(24));
    REQUIRE(exact.size() > 20000);
    // A cell on the border of two columns may be rounded into both or neither.
    auto differ = std::ssize(exact);
    for (const auto& [cell, count] : cells_on(floor_in(1)))
        differ += count == 1 && exact.contains(cell) ? -1 : 1;
    CHECK(static_cast<double>(differ) < 2e-3 * static_cast<double>(exact.size()));
}

// A trapezoid: its edge_v is 1 + wedge s long at the place s of edge_u. Scatterers about the
// centroid instead of the middle would lie up to a third of edge_u off.
TEST_CASE("taper: the scatterers of a wedge lie on it, about its centroid") {
    Draws draws(7);
    for (int run = 0; run < 8; ++run) {
        const Eigen::AngleAxisf turn(draws.between(0.0F, 6.0F), Eigen::Vector3f::UnitX());
        const Eigen::Vector3f u = draws.between(0.5F, 1.0F) * (turn * Eigen::Vector3f::UnitY());
        const Eigen::Vector3f v = draws.between(0.5F, 1.0F) * (turn * Eigen::Vector3f::UnitZ());
        Sample sample = patch_of({40.0F, 0.3F, 0.0F}, {-1.0F, 0.0F, 0.0F}, u, v);
        sample.wedge = draws.between(-1.0F, 1.0F);
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        float farthest = 0.0F;  // in half edges
        for_each_scatterer({sample}, [&](const Scatterers& found, int k) {
            const Eigen::Vector3f p(found.pieces.x[k], found.pieces.y[k], found.pieces.z[k]);
            const Eigen::Vector3f d = p - sample.middle();
            const float s = d.dot(sample.edge_u) / sample.edge_u.squaredNorm();
            const float t = d.dot(sample.edge_v) / sample.edge_v.squaredNorm();
            farthest = std::max({farthest, std::fabs(s), std::fabs(t) - sample.wedge * s});
            sum += p.cast<double>().homogeneous();
        });
        REQUIRE(sum.w() > 500.0);
        CHECK(farthest < 1.02F);  // the width of a fan's column varies, too
        CHECK((sum.hnormalized() - sample.position.cast<double>()).norm() < 0.02);
    }
}
