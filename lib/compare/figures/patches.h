#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sonarsim {

/// The powers of one image, [range, beam], a range after the other.
struct PowerImage {
    std::span<const float> power;
    int ranges = 0;
    int beams = 0;

    float at(int range, int beam) const {
        return power[static_cast<std::size_t>(range) * static_cast<std::size_t>(beams) +
                     static_cast<std::size_t>(beam)];
    }
};

struct PatchSize {
    int ranges = 32;
    int beams = 16;
};

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

    PatchSize size() const { return size_; }
    /// The patch with this first range and beam, which must lie in the image; nothing where it is
    /// empty, or where the trend falls to 0.15 of the mean: an edge lies there.
    std::optional<Patch> patch_of(const PowerImage& image, int range, int beam) const;

  private:
    PatchSize size_;
    std::vector<std::vector<double>> basis_;  ///< orthonormal functions of a pixel of the patch
};

}  // namespace sonarsim
