#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "input/mission/seabed_keys.h"

namespace sonarsim {

/// A part of the endless grid of a bed's heights. Cells are counted from the bed's (0, 0), to the
/// east and to the north; the height of a cell stands at its centre. The northern row is the first.
struct BedGrid {
    double cell_m = 1.0;
    std::int64_t west = 0;   ///< number of the first column
    std::int64_t north = 0;  ///< number of the first row, the largest
    int columns = 0;
    int rows = 0;

    std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    /// The centres of a column and of a row, in metres of the bed.
    double x_m(int column) const { return (static_cast<double>(west + column) + 0.5) * cell_m; }
    double y_m(int row) const { return (static_cast<double>(north - row) + 0.5) * cell_m; }
};

/// The subjects of the draws for a bed. Draws of different subjects are independent.
enum class BedDraw : std::uint32_t {
    roughness = 1,  ///< the octave as `number`
    ripples = 2,
    sediments = 6,  ///< the octave as `number`
    rocks = 10,
    rock_shapes = 11,
};

inline PhiloxKey bed_key(std::uint64_t seed, BedDraw subject, std::uint32_t number = 0) {
    return stream_key(seed, static_cast<std::uint32_t>(subject), number, stream_named("seabed"));
}

/// The deviation of the wave vector along each axis, as a share of its length. It has no source.
inline constexpr double ripple_spread = 0.05;

/// Adds ripples, in metres. Their height is that of a cosine, height_m / 2 Re(exp(i k x) b / |b|),
/// where the complex Gaussian field b moves the crests. At the zeros of b, of which a square metre
/// has 2 pi (ripple_spread / length_m)^2, a crest ends and the height falls to 0.
void add_ripples(const BedGrid& grid, const BedRippleConfig& ripples, std::uint64_t seed,
                 std::vector<double>& heights);

/// Converts a spectral strength from cm^4, the unit of the literature (lengths in cm, k in rad/cm),
/// to m^(4 - exponent), for lengths in m and k in rad/m.
double roughness_strength(double spectral_strength_cm4, double exponent);

/// Adds random heights with an isotropic spectrum W(k) = strength (k^2 + k0^2)^(-exponent / 2), in
/// metres, with k0 = 2 pi / corner_m. The spectrum holds within 0.6 dB from the corner down to
/// wavelengths of 12 cells and is 1.5 dB lower at 8 cells, 7 dB at 4: flat facets show there.
///
/// (k^2 + k0^2)^-a is the integral of t^(a-1) exp(-t (k^2 + k0^2)) dt / Gamma(a), a mixture of the
/// spectra of smooth fields. The sum over t in steps of a factor 4, one field for each octave of
/// lengths, equals this integral within 4 %.
void add_roughness(const BedGrid& grid, const BedRoughnessConfig& roughness, std::uint64_t seed,
                   std::vector<double>& heights);

/// A Gaussian random field on the cells of a grid, in its order: mean 0, variance 1, correlation
/// exp(-(r / (2 length))^2) at the distance r. Its power spectrum over wave vectors k, whose
/// integral is the variance, is length^2 / pi exp(-(length k)^2).
///
/// The field is a sum of bells exp(-(r / length)^2 / 2) on a square lattice of spacing `length`,
/// each times a normal number. The lattice makes the variance vary by 1e-4 of itself. A value
/// depends only on the key and on the place, not on the part of the grid that is made. A length
/// below a hundredth of a cell is a hundredth: in both cases no two cells are correlated.
std::vector<float> smooth_field(const BedGrid& grid, double length_m, PhiloxKey key);

}  // namespace sonarsim
