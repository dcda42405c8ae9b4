#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/calibrated/scatterers.h"

namespace sonarsim {

/// The relief of sea beds that no mesh has: it tilts the surface towards the sonar and away from
/// it, so patches of all sizes are brighter or darker. By Lambert's rule, sin^2 of the grazing
/// angle g, a tilt of t towards the sonar makes an echo 1 + 2 t / tan(g) times as strong to first
/// order. With normal tilts of the deviation s it is
///
///     exp(c t / s - c^2 / 2),    c = 2 s / tan(g),
///
/// with the mean 1. s follows from the spectrum of the roughness W(K) = w K^-b of the sea bed
/// (SeaBed), as the slope along a line of all waves longer than `shortest_m`:
///
///     s^2 = pi w / (4 - b) (2 pi / shortest_m)^(4 - b)
///
/// at most 0.2 as in APL-UW TR 9407, and c is at most 1, since steeper slopes cast shadows. Tilts
/// lie on a square of the world that repeats itself, with the spectrum of usual sea beds, b = 3.25.
class Relief {
  public:
    static constexpr double shortest_m = 0.1;  ///< a choice: about the beam of a sonar at 10 m
    /// Number of texels along the square, and their edge.
    static constexpr int size = 256;
    static constexpr double texel_m = 0.05;
    static constexpr float per_deviation = 32.0F;

    /// Tilts along x and y of the world, times `per_deviation` over their deviation; and that, rad.
    struct Tilts {
        PatchBlock::Array<float> x, y, deviation;
    };

    Relief() = default;  ///< none
    /// `factor`: on the deviations.
    Relief(std::span<const Material> materials, const Water& water, double factor);

    bool exists() const { return !tilts_.empty(); }
    /// The tilts at places of surface of these materials; `key` moves the square. The deviation is
    /// 0 where the surface is no sea bed.
    void find(const WorldPlaces& places, std::span<const std::uint32_t> materials, PhiloxKey key,
              Tilts& out) const;

  private:
    struct Tilt {
        std::int8_t x, y;
    };
    static std::vector<Tilt> make_tilts();

    std::vector<float> deviations_;
    std::vector<Tilt> tilts_;  ///< [size, size], rows along x
};

/// Multiplies the powers of echoes by the factors of the relief at their places.
void add_relief(const PatchBlock& pieces, const Relief& relief, const SonarInScene& sonar,
                PhiloxKey key, PointEchoes& echoes);

}  // namespace sonarsim
