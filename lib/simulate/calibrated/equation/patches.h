#pragma once

#include <array>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/taper.h"
#include "simulate/trace/traced_ping.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A block of pieces of surface, each small enough to be a point. Arrays, so that loops vectorise.
struct PatchBlock {
    static constexpr int capacity = 256;
    static constexpr int spare = 8;  ///< whole vectors are written
    template <class T>
    using Array = std::array<T, capacity + spare>;

    int count = 0;
    Array<float> x{}, y{}, z{};  ///< m, sensor frame
    Array<float> area_m2{};      ///< times the strength of the sample, since energies add
    Array<float> height_m{};     ///< the sonar's height above the piece's plane
    Array<float> half_range_m{}, half_sine{};  ///< half extents, of pieces of samples
    Array<std::uint32_t> material{};
    Array<std::uint32_t> sample{};  ///< index into the samples that are cut, if they are
};

/// The greatest size of a piece. The least of these limits applies in every direction.
struct PointLimits {
    float depth_m = 0.0F;         ///< in range; 0: any
    float sine = 0.0F;            ///< across the beams, y / range; 0: any
    float elevation_sine = 0.0F;  ///< in elevation, z / range; 0: any
    float range_min_m = 0.0F;     ///< samples that are wholly nearer have no pieces
};

/// True if all of a sample at a range is nearer than another. Before the first bin it has no echo.
inline bool is_wholly_nearer(const Sample& sample, float range_m, float than_m) {
    if (!(range_m < than_m)) return false;
    const float half_m =
        sample.edge_u.norm() + (1.0F + std::fabs(sample.wedge)) * sample.edge_v.norm();
    return range_m + half_m < than_m;
}

/// The number of pieces along a half edge with these extents.
inline int patches_along(const EdgeExtents& half_edge, float range_m, const PointLimits& limits) {
    constexpr float max_patches = 256.0F;
    const auto [depth, y, z] = half_edge;
    float wanted = 1.0F;
    const float per_range = 2.0F / range_m;
    if (limits.depth_m > 0.0F) wanted = std::max(wanted, 2.0F * std::fabs(depth) / limits.depth_m);
    if (limits.sine > 0.0F) wanted = std::max(wanted, std::fabs(y) * per_range / limits.sine);
    if (limits.elevation_sine > 0.0F)
        wanted = std::max(wanted, std::fabs(z) * per_range / limits.elevation_sine);
    return static_cast<int>(std::ceil(std::min(wanted, max_patches)));
}

/// Half the extents of a piece in range, and across the beams.
struct HalfExtents {
    float range_m, sine;
};

/// The same of a piece of a footprint with half edges `u` and `v`, cut into rows and columns.
inline HalfExtents half_extents(const EdgeExtents& u, const EdgeExtents& v, float range_m,
                                int rows = 1, int columns = 1) {
    const auto by_u = static_cast<float>(rows);
    const auto by_v = static_cast<float>(columns);
    return {std::fabs(u.depth) / by_u + std::fabs(v.depth) / by_v,
            std::fabs(u.y) / range_m / by_u + std::fabs(v.y) / range_m / by_v};
}

/// Calls use(s, t) for the middles of the pieces of a footprint that is cut into rows along one
/// half edge and columns along the other: places in half edges from its centre.
template <class Use>
void for_each_middle(int rows, int columns, Use use) {
    const auto place = [](int at, int of) {
        return (2.0F * static_cast<float>(at) + 1.0F) / static_cast<float>(of) - 1.0F;
    };
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j)
            use(place(i, rows), place(j, columns));
    }
}

/// Cuts samples into pieces and hands these to `use`, a block at a time. With the shape of the
/// view, pieces have shares of the area by the widths of the footprint.
template <class Use>
void subdivide(std::span<const Sample> samples, std::optional<ViewShape> shape,
               const PointLimits& limits, PatchBlock& pieces, Use use) {
    pieces.count = 0;
    for (std::uint32_t number = 0; number < samples.size(); ++number) {
        const Sample& sample = samples[number];
        const auto [range, direction] = arrival_of(sample.position);
        if (!(range > 0.0F) || is_wholly_nearer(sample, range, limits.range_min_m)) continue;
        const EdgeExtents u = extents_of(sample.edge_u, direction);
        const EdgeExtents v = extents_of(sample.edge_v, direction);
        const int by_u = patches_along(u, range, limits);
        const int by_v = patches_along(v, range, limits);
        // Rows are long, since they are written in whole vectors.
        const int rows = std::min(by_u, by_v);
        const int columns = std::max(by_u, by_v);
        const Eigen::Vector3f& across = by_u > by_v ? sample.edge_v : sample.edge_u;
        const Eigen::Vector3f& along = by_u > by_v ? sample.edge_u : sample.edge_v;
        const float area = sample.area_m2 * sample.strength / static_cast<float>(rows * columns);
        const Taper taper = trapezoid_of(sample, shape);
        const float taper_across = by_u > by_v ? taper.v : taper.u;
        const float taper_along = by_u > by_v ? taper.u : taper.v;
        const float area_step = area * taper_along * 2.0F / static_cast<float>(columns);
        const HalfExtents half = half_extents(u, v, range, by_u, by_v);
        const HalfExtents half_of_v = half_extents({}, v, range, by_u, by_v);
        const Eigen::Vector3f centre = middle_of(sample, by_u);
        for (int i = 0; i < rows; ++i) {
            const float place =
                (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(rows) - 1.0F;
            // A row along `edge_v` is longer where the wedge is; one along `edge_u` is turned.
            const float longer = sample.wedge * place;
            // The same of the extents of pieces along `edge_v`: at the row's start, and by column.
            const float at_start = by_u > by_v ? -sample.wedge : longer;
            const float by_column =
                by_u > by_v ? sample.wedge * 2.0F / static_cast<float>(columns) : 0.0F;
            const Eigen::Vector3f half_row = by_u > by_v ? Eigen::Vector3f(along + longer * across)
                                                         : Eigen::Vector3f((1.0F + longer) * along);
            const Eigen::Vector3f row = centre + place * across - half_row;
            const Eigen::Vector3f step_v = 2.0F / static_cast<float>(columns) * half_row;
            const float area_of_row = area * (1.0F + taper_across * place - taper_along);
            for (int first = 0; first < columns; first += PatchBlock::spare) {
                if (pieces.count > PatchBlock::capacity - PatchBlock::spare) {
                    use(pieces);
                    pieces.count = 0;
                }
                const int at = pieces.count;
                const auto along_row = [&](PatchBlock::Array<float>& to, float start, float step) {
                    for (int lane = 0; lane < PatchBlock::spare; ++lane) {
                        const float t = static_cast<float>(first + lane) + 0.5F;
                        to[at + lane] = std::fma(t, step, start);
                    }
                };
                along_row(pieces.x, row.x(), step_v.x());
                along_row(pieces.y, row.y(), step_v.y());
                along_row(pieces.z, row.z(), step_v.z());
                along_row(pieces.area_m2, area_of_row, area_step);
                std::fill_n(pieces.height_m.data() + at, PatchBlock::spare, sample.height_m);
                along_row(pieces.half_range_m, half.range_m + at_start * half_of_v.range_m,
                          by_column * half_of_v.range_m);
                along_row(pieces.half_sine, half.sine + at_start * half_of_v.sine,
                          by_column * half_of_v.sine);
                std::fill_n(pieces.material.data() + at, PatchBlock::spare, sample.material);
                std::fill_n(pieces.sample.data() + at, PatchBlock::spare, number);
                pieces.count += std::min(columns - first, PatchBlock::spare);
            }
        }
    }
    if (pieces.count > 0) use(pieces);
}

/// The strengths of a scene's map at pieces of samples. Samples cut by texels would be too many.
class PieceStrengths {
  public:
    PieceStrengths(const TracedPing& traced, const Scene& scene, ViewShape shape);

    /// Multiplies the powers of pieces of `surface` by the mean strengths over these pieces, into
    /// which samples were cut by `limits`; null: the pieces are points.
    void apply(std::span<const Sample> surface, const PatchBlock& pieces, const PointLimits* limits,
               PatchBlock::Array<float>& power) const;
    /// The strength at the centre of a sample.
    float at(const Sample& sample) const;

  private:
    Eigen::Vector2d ground_of(const Eigen::Vector3f& point) const;
    Eigen::Vector2d half_of_piece(const Sample& sample, const PointLimits& limits) const;

    const GroundMaps* maps_;  ///< null: the samples have their strengths
    TruePlaces places_;
    Eigen::Matrix<double, 2, 3> R_;  ///< from the sensor frame to the world's x and y
};

}  // namespace sonarsim
