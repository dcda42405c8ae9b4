#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "calibrated/sonar_equation.h"
#include "calibrated/target_pieces.h"
#include "core/random.h"

namespace sonarsim {

/// The size in which the pieces of a target are joined to scatterers; 0: any size.
struct TargetCells {
    float depth_m = 0.0F;      ///< in range
    float sine_y = 0.0F;       ///< y / range
    float sine_z = 0.0F;       ///< z / range
    double turns_per_m = 0.0;  ///< two-way phase: 2 / wavelength
};

/// Joins the echoes of pieces to scatterers, each with one phase.
///
/// The pieces of one smooth surface of a target that lie within a resolution cell make one
/// scatterer. The cells are counted from the middle of the highlight, where facets face the sonar.
/// So a highlight smaller than a cell is one scatterer, at its place, with the highlight's energy,
/// and does not flicker as the sonar moves. The scatterers of a larger highlight, and those of
/// other surface, have exponential strengths; the transition is gradual. A scatterer keeps its
/// phase and its draw from ping to ping.
class TargetScatterers {
  public:
    using ScattererUse = std::function<void(const PatchBlock&, PointEchoes&, Amplitudes&)>;

    /// Adds the echoes of a block of pieces, which come surface after surface.
    void add(const TargetPieces& pieces, const PointEchoes& echoes,
             std::span<const TargetFacet> facets, std::span<const float> slopes);

    /// Hands the scatterers to `use`, a block at a time, with their amplitudes and all of the
    /// echoes but the columns.
    void finish(const TargetCells& cells, const SonarEquation& equation, PhiloxKey key,
                const ScattererUse& use);

  private:
    /// Terms of the sums over echoes, each times the power of the echo: 1, the range, x, y, z, and
    /// 1 if the echo belongs to the highlight.
    using Terms = Eigen::Array<float, 8, 1>;
    /// The echoes of one smooth surface: those from `first` on.
    struct Surface {
        std::uint32_t instance, region;
        std::size_t first;
    };
    /// The middle of a highlight. The cells of its surface are counted from there.
    struct Middle {
        float range_m, y, z;
        float highlight_power;
    };
    Middle middle_of(std::size_t first, std::size_t end) const;
    void find_cells(std::size_t first, std::size_t end, const Middle& middle,
                    const TargetCells& cells);

    std::vector<Surface> surfaces_;
    // One entry for each echo.
    std::vector<float> range_m_, y_, z_;
    std::vector<Terms> terms_;
    std::vector<std::uint64_t> cell_;
};

}  // namespace sonarsim
