#include "input/scene/seabed/seabed.h"

#include "input/scene/gltf/load.h"
#include "support/seabed.h"
#include "support/test.h"

namespace {

/// The power of a bed's heights at one wave vector, rad/m: the periodogram with Hann's window,
/// whose mean is the spectrum W, m^4, smoothed over two wave numbers; exponentially distributed.
double spectrum_at(const Seabed& bed, double kx, double ky) {
    const BedGrid& grid = bed.grid;
    const auto window = [](int i, int count) {
        return 0.5 - 0.5 * std::cos(2.0 * pi * (i + 0.5) / count);
    };
    std::vector<std::complex<double>> across;
    double weight_x = 0.0;
    for (int column = 0; column < grid.columns; ++column) {
        const double w = window(column, grid.columns);
        weight_x += w * w;
        across.push_back(w * std::polar(1.0, -kx * grid.x_m(column)));
    }
    std::complex<double> sum;
    double weight_y = 0.0;
    for (int row = 0; row < grid.rows; ++row) {
        std::complex<double> row_sum;
        const float* z = &bed.heights[static_cast<std::size_t>(row) * across.size()];
        for (std::size_t i = 0; i < across.size(); ++i)
            row_sum += across[i] * static_cast<double>(z[i]);
        const double w = window(row, grid.rows);
        weight_y += w * w;
        sum += row_sum * w * std::polar(1.0, -ky * grid.y_m(row));
    }
    const double cell = grid.cell_m;
    return std::norm(sum) * cell * cell / (4.0 * pi * pi * weight_x * weight_y);
}

SeabedRule rule_of_size(double half_m, double cell_m = 0.05) {
    SeabedRule rule;
    rule.cell_m = cell_m;
    rule.window = {-half_m, -half_m, half_m, half_m};
    return rule;
}

PhiloxKey key_of(std::uint32_t number) {
    return bed_key(7, BedDraw::roughness, number);
}

}  // namespace

TEST_CASE("the spectrum of a bed has its strength and exponent" * doctest::skip(sanitized)) {
    // 28 beds, 6 wavelengths from 1 m to 12 cells, 8 directions each, which lie more than the
    // window's width apart: each mean of a wavelength has the deviation 1 / sqrt(28 * 8) = 6.7 %.
    constexpr int beds = 28;
    constexpr int wavelengths = 6;
    constexpr int directions = 8;
    using Values = Eigen::Array<double, wavelengths, 1>;
    SeabedRule rule = rule_of_size(4.0, 0.025);
    rule.roughness = BedRoughnessConfig{0.004, 3.0, 2.0};
    Values ratios = Values::Zero();
    Values logs;
    const double corner = 2.0 * pi / rule.roughness->corner_m;
    for (int b = 0; b < beds; ++b) {
        rule.seed = static_cast<std::uint64_t>(b);
        const Seabed bed = make_seabed(rule);
        for (int n = 0; n < wavelengths; ++n) {
            const double k = 2.0 * pi / std::pow(0.3, n / (wavelengths - 1.0));
            const double expected =
                roughness_strength(0.004, 3.0) * std::pow(k * k + corner * corner, -1.5);
            for (int d = 0; d < directions; ++d) {
                const double angle = pi * (d + 0.3) / directions;
                const double found = spectrum_at(bed, k * std::cos(angle), k * std::sin(angle));
                ratios[n] += found / expected / (beds * directions);
            }
            logs[n] = std::log(k);
        }
    }
    CAPTURE(ratios.transpose());
    // 4 deviations (p = 6e-5), and 4 % for the steps of the octaves.
    CHECK((ratios - 1.0).abs().maxCoeff() < 0.31);
    // The mean of all has 2.7 %.
    CHECK(std::abs(ratios.mean() - 1.0) < 0.15);
    // The slope of the ratios, of deviation 0.067 / sqrt(sum of squares of log k).
    logs -= logs.mean();
    const double squares = logs.square().sum();
    const double slope = (logs * ratios.log()).sum() / squares;
    CHECK(std::abs(slope) < 4.0 * 0.067 / std::sqrt(squares) + 0.05);
}

TEST_CASE("neighbouring facets of a rough bed have similar slopes") {
    // The roughest field correlates by 0.59, the longer ones by more; white heights by -0.5.
    SeabedRule rule = rule_of_size(5.0);
    rule.roughness = BedRoughnessConfig{0.004, 3.0, 2.0};
    const Seabed bed = make_seabed(rule);
    const Eigen::Index columns = bed.grid.columns;
    const Eigen::ArrayXXd z =
        Eigen::Map<const Eigen::ArrayXXf>(bed.heights.data(), columns, bed.grid.rows)
            .cast<double>();
    const Eigen::ArrayXXd slope = z.bottomRows(columns - 1) - z.topRows(columns - 1);
    const auto here = slope.topRows(columns - 2);
    CHECK((here * slope.bottomRows(columns - 2)).sum() / here.square().sum() > 0.59);
}

TEST_CASE("ripples have their length, direction and height" * doctest::skip(sanitized)) {
    for (const double angle : {0.4, 2.0}) {
        SeabedRule rule = rule_of_size(6.0);
        rule.seed = 3;
        rule.ripples = BedRippleConfig{0.03, 0.25, degrees(angle)};
        const Seabed bed = make_seabed(rule);
        const double k = 2.0 * pi / 0.25;
        double power = 0.0;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (int i = -7; i <= 7; ++i) {
            for (int j = -7; j <= 7; ++j) {
                const double kx = k * (std::cos(angle) + 0.025 * i);
                const double ky = k * (std::sin(angle) + 0.025 * j);
                const double found = spectrum_at(bed, kx, ky);
                power += found;
                sum += found * Eigen::Vector2d(kx, ky);
            }
        }
        // The bed has 144 m^2 (0.05 k)^2 / pi = 72 independent patches of wave vectors that deviate
        // by 5 %: 0.6 % and 0.006 rad, and limits of 4 deviations.
        CHECK(std::abs(2.0 * pi * power / sum.norm() / 0.25 - 1.0) < 0.024);
        CHECK(std::abs(std::atan2(sum.y(), sum.x()) - angle) < 0.024);
        const auto [low, high] = std::ranges::minmax(bed.heights);
        CHECK(high - low > 0.0285);
        CHECK(high - low <= 0.03);
    }
}

TEST_CASE("a bed of a size ends there") {
    SeabedRule rule = rule_of_size(100.0, 0.5);
    rule.size_m = {8.0, 5.0};
    rule.z_m = -7.0;
    PlacedFile placed;
    placed.z_up = true;
    placed.seabed = std::make_shared<const Seabed>(make_seabed(rule));
    SceneFiles files;
    const Surface surface = surface_of(placed, files);
    const Eigen::AlignedBox3d box = box_of(surface);
    CHECK((box.min() - Eigen::Vector3d(0.25, 0.25, -7.0)).norm() < 1e-6);
    CHECK((box.max() - Eigen::Vector3d(7.75, 4.75, -7.0)).norm() < 1e-6);
    CHECK(surface.triangles.size() == 2 * 15 * 9);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto c = corners_of(surface, t);
        CHECK((c[1] - c[0]).cross(c[2] - c[0]).z() > 0.0);
    }
}

TEST_CASE("a smooth field has variance 1 and the correlation of its length") {
    const BedGrid grid{0.5, -80, 79, 160, 160};
    constexpr int lag = 4;  // two lengths: exp(-1)
    constexpr int side = 160 - lag;
    // The mean, the square, and the products with the neighbours along x and y.
    Eigen::Array4d means = Eigen::Array4d::Zero();
    for (std::uint32_t n = 0; n < 16; ++n) {
        const std::vector<float> field = smooth_field(grid, 1.0, key_of(n));
        REQUIRE(field.size() == grid.size());
        const Eigen::ArrayXXd all =
            Eigen::Map<const Eigen::ArrayXXf>(field.data(), 160, 160).cast<double>();
        const auto here = all.topLeftCorner(side, side);
        means += Eigen::Array4d(here.mean(), here.square().mean(),
                                (here * all.block(lag, 0, side, side)).mean(),
                                (here * all.block(0, lag, side, side)).mean()) /
                 16.0;
    }
    // 4 deviations, each sqrt(4 pi / n) of n square lengths, 16 fields of 78^2.
    const Eigen::Array4d expected(0.0, 1.0, std::exp(-1.0), std::exp(-1.0));
    CHECK((means - expected).abs().maxCoeff() < 0.046);
}

TEST_CASE("a smooth field far below the cells takes no finer lattice, and cells are independent") {
    const BedGrid grid{0.5, -80, 79, 160, 160};
    const std::vector<float> field = smooth_field(grid, 1e-300, key_of(5));
    CHECK(field == smooth_field(grid, 0.005, key_of(5)));
    const Eigen::ArrayXd all =
        Eigen::Map<const Eigen::ArrayXf>(field.data(), 160 * 160).cast<double>();
    // 4 deviations: sqrt(2 / n) of a variance, sqrt(1 / n) of a correlation, n = 25,600.
    CHECK(std::abs(all.square().mean() - 1.0) < 0.036);
    CHECK(std::abs((all.head(25599) * all.tail(25599)).mean()) < 0.025);
}
