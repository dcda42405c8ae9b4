#pragma once

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/calibrated/signal/echo_grid.h"
#include "simulate/calibrated/signal/filtered_noise.h"
#include "simulate/calibrated/signal/fourier.h"
#include "simulate/calibrated/signal/line_array.h"

namespace sonarsim {

/// The receiver's noise in a ping, before its beams are formed.
struct ElementNoise {
    /// [range bins, to a multiple of 8] real and imaginary part each, per element.
    std::span<const float> row_sigma;
    FilteredNoise drawn;
};

/// Forms the beams of a line array. The Fourier transform of a grid of sines is the signal over the
/// array's aperture, one value per element. Each is weighted, its noise is added, and it is
/// transformed back. Beams between the columns of the grid are interpolated. Weights may differ
/// from eight rows to the next, as those of an array that is in focus at one range do.
class Beamformer {
  public:
    /// `beam_sines` are the sines of the beams' middles. `powers`: the grid holds powers, and the
    /// weights are those of the squared pattern. `defocus_rad`: for every 8 rows, the quadratic
    /// phase at the ends of the array in addition to its own; empty: in focus.
    Beamformer(const LineArray& array, const std::vector<double>& beam_sines, bool powers,
               const ElementsConfig& elements = {}, std::span<const double> defocus_rad = {});

    const SineGrid& grid() const { return grid_; }
    int beams() const { return static_cast<int>(first_tap_.size()); }
    /// Scalloping correction: mean power over positions between two columns / power in a column.
    float scalloping_gain() const { return scalloping_gain_; }
    /// The sigma of the elements for a noise of power 1 in a beam.
    float element_sigma_of_unit() const { return unit_sigma_; }

    struct Scratch {
        explicit Scratch(const Beamformer& beams)
            : data(beams.fourier_.size()), spare(beams.fourier_.size()) {}
        std::vector<ComplexLanes> data, spare;
    };
    /// `taps`: the filter along range, by noise_taps().
    ElementNoise noise_of_ping(std::span<const float> row_sigma, const std::vector<float>& taps,
                               PhiloxKey key) const;
    /// Forms the beams of 8 bins from `row` on: `out` [beams][8], the power of each. Without a grid
    /// there are no echoes. `noise` may be null.
    void form(const EchoGrid* grid, int row, ElementNoise* noise, Scratch& scratch,
              Lanes* out) const;

  private:
    static constexpr int max_taps = 8;
    struct Weight {
        float re, im;
        int index;          ///< element of the transform
        float noise_scale;  ///< undoes the correction of interpolation, which noise does not need
    };

    void add_weights(const LineArray& array, double samples, const ElementsConfig& element_errors);
    void find_taps(const std::vector<double>& beam_sines);
    void add_noise(ElementNoise& noise, int row, Scratch& scratch) const;
    std::span<const Weight> weights_at(int row) const {
        const std::size_t first = std::size_t{1} * (row / lanes) * elements_;
        return {weights_.data() + (first < weights_.size() ? first : 0),
                static_cast<std::size_t>(elements_)};
    }

    bool powers_;
    SineGrid grid_;
    Fourier fourier_;
    int elements_ = 0;
    std::vector<Weight> weights_;  ///< [1 or blocks of 8 rows, elements]
    int taps_ = 1;
    std::vector<int> first_tap_;  ///< [beams]
    std::vector<float> tap_;      ///< [beams, taps]
    float scalloping_gain_ = 1.0F;
    float unit_sigma_ = 0.0F;
};

/// The grid on which the beams of an array are formed.
SineGrid sine_grid(const LineArray& array, const std::vector<double>& beam_sines);

}  // namespace sonarsim
