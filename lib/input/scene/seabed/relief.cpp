#include "input/scene/seabed/relief.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// Real or imaginary part of the field that moves the crests. Its wave vectors have the standard
/// deviation `ripple_spread` times the ripples' wave number.
std::vector<float> crest_field(const BedGrid& grid, const BedRippleConfig& ripples,
                               std::uint32_t part, std::uint64_t seed) {
    // exp(-(length k)^2) has the deviation 1 / (sqrt(2) length).
    const double deviation = ripple_spread * 2.0 * pi / ripples.length_m;
    return smooth_field(grid, 1.0 / (std::sqrt(2.0) * deviation),
                        bed_key(seed, BedDraw::ripples, part));
}

/// Number of bells on each side of a point, along one axis. The next bell has fallen to 4e-6.
constexpr int reach = 5;
constexpr int taps = 2 * reach;

/// The bells that reach a point along one axis.
struct Taps {
    std::int64_t first;               ///< number of the first bell
    std::array<float, taps> weights;  ///< the bells' values at the point
};

Taps taps_at(double x_m, double length_m) {
    const double at = x_m / length_m;
    Taps out{static_cast<std::int64_t>(std::floor(at)) - reach + 1, {}};
    // The squares of the weights along both axes sum to 1.
    const double scale = 1.0 / std::sqrt(std::sqrt(pi));
    for (int k = 0; k < taps; ++k) {
        const double off = at - static_cast<double>(out.first + k);
        out.weights[static_cast<std::size_t>(k)] =
            static_cast<float>(scale * exponential(-0.5 * off * off));
    }
    return out;
}

/// The normal numbers of the lattice, row by row. Four neighbours in a row share a draw.
class Lattice {
  public:
    Lattice(PhiloxKey key, std::int64_t first, std::int64_t last) : key_(key), start_(first >> 2) {
        const auto draws = static_cast<std::size_t>((last >> 2) - start_ + 1);
        x0_.resize((draws + 7) / 8 * 8);
        x1_.resize(x0_.size());
        for (Row& row : rows_)
            row.values.resize(4 * x0_.size());
    }

    /// Number of the bell that is the first of a row.
    std::int64_t first() const { return 4 * start_; }
    std::size_t width() const { return 4 * x0_.size(); }

    const float* row(std::int64_t number) {
        Row& kept = rows_[static_cast<std::size_t>(((number % taps) + taps) % taps)];
        if (kept.number != number) draw(number, kept);
        return kept.values.data();
    }

  private:
    struct Row {
        std::optional<std::int64_t> number = {};
        std::vector<float> values = {};
    };

    void draw(std::int64_t number, Row& row) {
        for (std::size_t k = 0; k < x0_.size(); ++k) {
            x0_[k] = static_cast<std::uint32_t>(start_ + static_cast<std::int64_t>(k));
            x1_[k] = static_cast<std::uint32_t>(number);
        }
        philox_pairs(x0_.data(), x1_.data(), x0_.size(), key_);
        for (std::size_t k = 0; k < x0_.size(); ++k) {
            const NormalPair a = normal_pair(x0_[k]);
            const NormalPair b = normal_pair(x1_[k]);
            row.values[4 * k] = a.first;
            row.values[4 * k + 1] = a.second;
            row.values[4 * k + 2] = b.first;
            row.values[4 * k + 3] = b.second;
        }
        row.number = number;
    }

    PhiloxKey key_;
    std::int64_t start_;
    std::vector<std::uint32_t> x0_;
    std::vector<std::uint32_t> x1_;
    std::array<Row, taps> rows_;
};

}  // namespace

void add_ripples(const BedGrid& grid, const BedRippleConfig& ripples, std::uint64_t seed,
                 std::vector<double>& heights) {
    if (ripples.height_m == 0.0) return;
    const std::vector<float> real = crest_field(grid, ripples, 0, seed);
    const std::vector<float> imaginary = crest_field(grid, ripples, 1, seed);
    const SinCos direction = sincos(radians(ripples.direction_deg));
    // Added to |b|^2, whose mean is 2, so that a crest ends and its height falls to 0 where b is 0.
    constexpr double rounding = 0.05;
    std::size_t i = 0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column, ++i) {
            const double turns =
                (direction.cos * grid.x_m(column) + direction.sin * grid.y_m(row)) /
                ripples.length_m;
            const SinCos wave = sincos(2.0 * pi * (turns - std::floor(turns)));
            const auto re = static_cast<double>(real[i]);
            const auto im = static_cast<double>(imaginary[i]);
            const double height =
                (re * wave.cos - im * wave.sin) / std::sqrt(re * re + im * im + rounding);
            heights[i] += 0.5 * ripples.height_m * height;
        }
    }
}

double roughness_strength(double spectral_strength_cm4, double exponent) {
    constexpr double m_per_cm = 0.01;
    // W m^-4 = w cm^4 (k cm)^-exponent, with cm = 0.01 m.
    return spectral_strength_cm4 * power(m_per_cm, 4.0 - exponent);
}

void add_roughness(const BedGrid& grid, const BedRoughnessConfig& roughness, std::uint64_t seed,
                   std::vector<double>& heights) {
    const double exponent = roughness.spectral_exponent;
    const double strength = roughness_strength(roughness.spectral_strength_cm4, exponent);
    if (strength == 0.0) return;
    // The square t of the shortest length of a field, in cells. The slopes of neighbouring facets
    // correlate by (1 - 1 / (2 t)) exp(-1 / (4 t)) = 0.59 in that field; with less, facets show.
    constexpr double min_t = 1.6;
    constexpr double step = 4.0;
    // Fields with a larger t k0^2 are left out: their factor exp(-t k0^2) is below e^-10.
    constexpr double max_decay = 10.0;
    const double corner = 2.0 * pi / roughness.corner_m;
    const double a = 0.5 * exponent;
    const double factor = strength * pi * logarithm(step) * exponential(-log_gamma(a));
    double t = min_t * grid.cell_m * grid.cell_m;
    for (std::uint32_t octave = 0; t * corner * corner < max_decay; ++octave, t *= step) {
        const double variance = factor * power(t, a - 1.0) * exponential(-t * corner * corner);
        const double deviation = std::sqrt(variance);
        const std::vector<float> field =
            smooth_field(grid, std::sqrt(t), bed_key(seed, BedDraw::roughness, octave));
        for (std::size_t i = 0; i < heights.size(); ++i)
            heights[i] += deviation * static_cast<double>(field[i]);
    }
}

std::vector<float> smooth_field(const BedGrid& grid, double length_m, PhiloxKey key) {
    // A finer lattice needs more room and time. Neighbouring cells are independent already.
    constexpr double min_share_of_cell = 0.01;
    length_m = std::max(length_m, min_share_of_cell * grid.cell_m);
    std::vector<float> out;
    if (grid.size() == 0) return out;
    out.reserve(grid.size());
    std::vector<Taps> across;
    across.reserve(static_cast<std::size_t>(grid.columns));
    for (int column = 0; column < grid.columns; ++column)
        across.push_back(taps_at(grid.x_m(column), length_m));
    Lattice lattice(key, across.front().first, across.back().first + taps - 1);
    std::vector<float> sums(lattice.width());
    for (int row = 0; row < grid.rows; ++row) {
        const Taps along = taps_at(grid.y_m(row), length_m);
        std::ranges::fill(sums, 0.0F);
        for (std::size_t k = 0; k < taps; ++k) {
            const float* normals = lattice.row(along.first + static_cast<std::int64_t>(k));
            for (std::size_t i = 0; i < sums.size(); ++i)
                sums[i] += along.weights[k] * normals[i];
        }
        for (const Taps& at : across) {
            const float* part = &sums[static_cast<std::size_t>(at.first - lattice.first())];
            float value = 0.0F;
            for (std::size_t k = 0; k < taps; ++k)
                value += at.weights[k] * part[k];
            out.push_back(value);
        }
    }
    return out;
}

}  // namespace sonarsim
