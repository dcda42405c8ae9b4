#include "calibrated/sonar_equation.h"

#include <algorithm>

#include "calibrated/line_array.h"

namespace sonarsim {

namespace {

constexpr int vector_lanes = 8;

using Floats = PieceBlock::Array<float>;

/// What the materials of pieces are like, in arrays of their own so that loops vectorise.
struct MaterialsOfPieces {
    Floats lambert, facet, inverse_slope2;

    MaterialsOfPieces(const PieceBlock& pieces, std::span<const Backscatter> materials, int count) {
        for (int k = 0; k < count; ++k) {
            const Backscatter& material = materials[pieces.material[k]];
            lambert[k] = material.lambert;
            facet[k] = material.facet;
            inverse_slope2[k] = material.inverse_slope2;
        }
    }
};

}  // namespace

ElevationPattern elevation_pattern(double width_rad, double side_lobe_db) {
    ElevationPattern out;
    if (width_rad <= 0.0) return out;
    const LineArray array = line_array(width_rad, side_lobe_db);
    for (int k = 0; k <= ElevationPattern::steps + 1; ++k) {
        const double sine = 2.0 * k / ElevationPattern::steps - 1.0;
        const double pattern = line_pattern(array, sine);
        out.power.push_back(static_cast<float>(pattern * pattern));
    }
    return out;
}

void weigh_by_elevation(const ElevationPattern& pattern, const PieceBlock& pieces, int count,
                        PointEchoes& echoes) {
    if (pattern.power.empty()) return;
    const float* const table = pattern.power.data();
    constexpr float half = 0.5F * ElevationPattern::steps;
    // Between the entries, at a sine within [-1, 1].
    Floats at, whole;
    for (int k = 0; k < count; ++k) {
        at[k] = half + half * (pieces.z[k] / echoes.range_m[k]);
        // In this order what is no number becomes 0.
        whole[k] = std::floor(std::min(2.0F * half, std::max(0.0F, at[k])));
    }
    for (int k = 0; k < count; ++k) {
        const float* const entry = table + static_cast<int>(whole[k]);
        echoes.power[k] *= std::fma(at[k] - whole[k], entry[1] - entry[0], entry[0]);
    }
}

std::uint64_t find_echoes(const PieceBlock& pieces, std::span<const Backscatter> materials,
                          const SonarEquation& equation, PointEchoes& echoes) {
    const int count = (pieces.count + vector_lanes - 1) / vector_lanes * vector_lanes;
    echoes.count = count;
    const float per_bin = 1.0F / equation.bin_m;
    const MaterialsOfPieces of(pieces, materials, count);
    for (int k = 0; k < count; ++k) {
        const float x = pieces.x[k];
        const float y = pieces.y[k];
        const float z = pieces.z[k];
        const float range = std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
        const float inverse = 1.0F / range;
        const float spreading = inverse * inverse;
        const float sine = std::min(pieces.height_m[k] * inverse, 1.0F);
        const Backscatter material{of.lambert[k], of.facet[k], of.inverse_slope2[k]};
        echoes.range_m[k] = range;
        echoes.power[k] = material.at(sine) * pieces.area_m2[k] * spreading * spreading *
                          fading(equation.loss_per_m * range);
        echoes.row[k] = (range - equation.range_min_m) * per_bin - 0.5F;
    }
    weigh_by_elevation(equation.elevation, pieces, count, echoes);
    const auto rows = static_cast<float>(equation.rows);
    int outside = 0;
    for (int k = 0; k < count; ++k) {
        const bool inside = echoes.row[k] > -0.5F && echoes.row[k] < rows - 0.5F;
        const bool meant = k < pieces.count;
        outside += meant && !inside ? 1 : 0;
        const bool kept = meant && inside;
        echoes.power[k] = kept ? echoes.power[k] : 0.0F;
        echoes.row[k] = kept ? echoes.row[k] : 0.0F;
    }
    return outside;
}

}  // namespace sonarsim
