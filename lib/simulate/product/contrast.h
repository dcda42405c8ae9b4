#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sonarsim {

/// Finds the brightness of a picture from all of its intensities.
class Gain {
  public:
    Gain();
    void add(std::span<const float> intensity);
    /// The 99 % quantile of the intensities above 0, to 3 %; 1 when there are none.
    double white() const;

  private:
    std::vector<std::uint64_t> counts_;  ///< histogram over the leading bits of the intensity
};

/// The shown amplitude of an intensity, which is power: sqrt(intensity / white), at most 1.
float shade(float intensity, float white);

/// 16-bit grey values: round(65535 intensity / full_scale), white above full_scale.
std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale);

/// Bins [first_line, last_line] x [first_bin, last_bin]. A line is a beam, a ping or a step.
struct BinBox {
    int first_line = 0, last_line = -1;
    int first_bin = 0, last_bin = -1;

    bool is_empty() const { return last_line < first_line; }
    void extend(int line, int bin);
};

/// A picture in bins, [lines, bins]: ids of objects and levels. Bins of one index have one range.
struct LevelMap {
    int lines = 0, bins = 0;
    std::span<const std::uint16_t> object;  ///< the object in the bin; 0: none
    /// The object whose shadow it is; 0: none. Empty: no shadows.
    std::span<const std::uint16_t> shadow;
    std::span<const float> level;
    bool full_turn = false;      ///< the last line is next to the first
    bool levels_by_bin = false;  ///< `level` is [bins, lines], as an image is

    /// The line that is counted as `line` on over the seam of a full turn.
    int line_at(int line) const { return ((line % lines) + lines) % lines; }
    /// `line` is one of the map.
    float level_at(int line, int bin) const {
        const auto l = static_cast<std::size_t>(line);
        const auto b = static_cast<std::size_t>(bin);
        return level[levels_by_bin ? b * lines + l : l * bins + b];
    }
};

/// The box of an id in `marks`. If it lies on both sides of the seam of a full turn, its lines are
/// counted on over the seam, and the first is below 0.
BinBox over_seam(const LevelMap& map, std::span<const std::uint16_t> marks, std::uint16_t id,
                 BinBox box);

/// The mean level of the bins with an id in `marks` (the objects or the shadows of a map, within
/// `box`) over that of their surroundings, dB, limited to 100 dB either way; nothing without
/// surroundings or if both have no echo. The surroundings stand for the image without the object:
/// bins of the same range on either side, over the width of the marked bins there and at least two,
/// that show only background and no shadow. Each range of the surroundings is weighted by its
/// number of marked bins. `is_background` is 1 for the ids of background.
std::optional<double> contrast_db(const LevelMap& map, std::span<const std::uint16_t> marks,
                                  std::uint16_t id, const BinBox& box,
                                  std::span<const std::uint8_t> is_background);

/// The shadows of the ids that are 1 in `wanted`, without their far ends that look like their
/// surroundings: each ends at the range up to which it is most below them by 1.5 dB in sum.
std::vector<std::uint16_t> visible_shadows(const LevelMap& map,
                                           std::span<const std::uint8_t> wanted,
                                           std::span<const std::uint8_t> is_background);

}  // namespace sonarsim
