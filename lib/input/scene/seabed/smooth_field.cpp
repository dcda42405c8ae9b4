#include "input/scene/seabed/smooth_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/units.h"

namespace sonarsim {

namespace {

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
        if (!kept.known || kept.number != number) draw(number, kept);
        return kept.values.data();
    }

  private:
    struct Row {
        bool known = false;
        std::int64_t number = 0;
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
        row.known = true;
        row.number = number;
    }

    PhiloxKey key_;
    std::int64_t start_;
    std::vector<std::uint32_t> x0_;
    std::vector<std::uint32_t> x1_;
    std::array<Row, taps> rows_;
};

}  // namespace

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
