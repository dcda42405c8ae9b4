#pragma once

#include <optional>
#include <vector>

#include "recording/patch_grid.h"

namespace sonarsim {

/// A patch without its trend.
struct Patch {
    std::vector<float> amplitude;  ///< relative to the trend; their mean square is 1
    double mean_power = 0.0;
    double trend = 0.0;  ///< the standard deviation of the trend over the mean power
};

/// Takes the trend out of patches of one size: a surface of second order is fitted to the powers,
/// and the amplitudes are divided by its root.
class Detrender {
  public:
    explicit Detrender(PatchSize size);

    /// A patch of the image; nothing where it is empty, or where the trend falls to 0.15 of the
    /// mean: an edge lies there.
    std::optional<Patch> patch_of(const ImageView& image, const PatchGrid& grid, int place) const;

  private:
    std::vector<std::vector<double>> basis_;  ///< orthonormal functions of a pixel of the patch
};

}  // namespace sonarsim
