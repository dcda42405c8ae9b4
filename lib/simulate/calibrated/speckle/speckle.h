#pragma once

#include "core/random.h"
#include "input/scene/scene.h"
#include "simulate/calibrated/signal/echo_grid.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/trace/ping_motion.h"

namespace sonarsim {

/// The form in which mean powers are added to a cell of a grid.
enum class PowerForm {
    power,     ///< they are added to the power in the cell
    amplitude  ///< a complex normal amplitude of that power is added
};

/// Adds the mean powers of a column's bins. Bins are read and written up to a multiple of 8. Powers
/// below 0 count as 0. `gain`: a factor on the powers of amplitudes, drawn by key, bin and column.
void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid);

/// Turns the powers of a grid into independent amplitudes of `gain` times these mean powers.
void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key);

/// The texture of surface: patches whose echoes are stronger or weaker, the same in every ping. It
/// is a field in dB with equal variance in each octave of wavelength, as side-scan records of sand
/// have it. Shorter waves than 1.6 m would raise the correlations within a metre above those of a
/// record. Its deviation in an octave is
///
///     t = 1.2 - 0.08 (phi - 1.5) dB for a sea bed of the grain size phi, 0.6 dB for the rest.
///
/// Sand is set by hand by the spread of the means of blocks of 0.23 to 1.9 m in one 600 kHz
/// side-scan record; the other numbers are a rule. A factor 10^(dB / 10) is divided by its mean,
/// exp((ln(10) / 10)^2 octaves t^2 / 2).
class Texture {
  public:
    /// A square of the world that repeats itself, and its octaves.
    struct Square {
        int size;        ///< texels along it
        double texel_m;  ///< edge of a texel
        int octaves;     ///< the longest wave is its edge
        double edge_m() const { return size * texel_m; }
    };
    /// Waves of 1.6 to 25.6 and to 205 m, of eight texels or more, with a linear field between.
    static constexpr Square fine{128, 0.2, 4};
    static constexpr Square coarse{64, 3.2, 3};
    static constexpr int octaves = fine.octaves + coarse.octaves;

    Texture() = default;  ///< none
    /// `factor`: on the deviations in dB.
    Texture(std::span<const Material> materials, double factor);

    bool exists() const { return !fine_.empty(); }
    /// Multiplies the powers of pieces of `samples` by the factors there. `key` moves the squares.
    void apply(std::span<const Sample> samples, const PatchBlock& pieces, const SonarInScene& sonar,
               const TruePlaces& places, PhiloxKey key, PatchBlock::Array<float>& power) const;

  private:
    /// exp(gain * field + offset), field in deviations of an octave.
    struct Strength {
        float gain, offset;
    };
    std::vector<Strength> strengths_;  ///< [materials]
    /// [size + 1, size + 1], rows along x; the last repeat the first.
    std::vector<float> fine_, coarse_;
};

}  // namespace sonarsim
