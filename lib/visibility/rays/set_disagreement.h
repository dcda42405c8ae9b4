#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/rays/ray_set.h"

namespace sonarsim {

/// A comparison of the noise-free images of two sets of rays, see RaySet.
struct SetDisagreement {
    double signal = 0.0;        ///< signal of the image by all rays
    double difference = 0.0;    ///< sum over bins that both sets occupy
    double first_alone = 0.0;   ///< signal of bins that only the first set occupies
    double second_alone = 0.0;  ///< signal of bins that only the second set occupies
    double squares = 0.0;       ///< squared differences of all bins
    int every = 1;              ///< these beams were compared: 0, every, 2 every, ...
    std::vector<std::uint8_t>
        occupied;  ///< [compared beams, range bins]: 1 if the image has an echo

    /// Relative L1 of the image of all samples, plus twice its standard error; 0 without signal.
    double error() const;
};

/// The bins of an image in all beams, with no comparison.
SetDisagreement of_all_beams(const View& view, const Samples& samples);

/// Compares the images of a view with at most about 64 beams, evenly spread, to save time.
class SetComparison {
  public:
    /// `materials` must outlive it.
    SetComparison(const View& view, std::span<const Material> materials);

    /// Adds all samples of a beam; `sets` names the set of each.
    void add_beam(int beam, std::span<const Sample> samples, std::span<const RaySet> sets);

    const SetDisagreement& result() const { return result_; }

  private:
    void add(const Sample& sample, RaySet set);
    void compare_bins(std::uint8_t* occupied);

    /// Sums over the samples in a bin. Their quotient is the mean echo.
    struct Sum {
        float weight = 0.0F;
        float echo = 0.0F;

        float mean() const { return weight > 0.0F ? echo / weight : 0.0F; }
        Sum times(float factor) const { return {weight * factor, echo * factor}; }
        Sum operator+(const Sum& more) const { return {weight + more.weight, echo + more.echo}; }
    };
    using Bin = std::array<Sum, ray_sets>;  ///< indexed by RaySet

    static void compare_bin(const Bin& bin, SetDisagreement& out);

    std::span<const Material> materials_;
    float range_min_m_;
    float per_bin_;
    std::vector<Bin> bins_;
    int begin_;  ///< bins outside of [begin_, end_) are dark
    int end_ = 0;
    SetDisagreement result_;
};

}  // namespace sonarsim
