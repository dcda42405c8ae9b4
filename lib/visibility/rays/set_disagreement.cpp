#include "visibility/rays/set_disagreement.h"

#include <algorithm>
#include <cmath>

#include "core/overlapped_bins.h"
#include "visibility/rays/sampling.h"

namespace sonarsim {

namespace {

// The sums over 64 beams are known to a few per cent.
constexpr int most_compared_beams = 64;

/// Half of a sample's extent in range, in bins.
float half_extent(const Sample& sample, float per_range, float per_bin) {
    // Avoids a division by zero for a patch without depth.
    constexpr float least_half = 1e-3F;
    return std::max((std::fabs(sample.position.dot(sample.edge_u)) +
                     std::fabs(sample.position.dot(sample.edge_v))) *
                        per_range * per_bin,
                    least_half);
}

}  // namespace

double SetDisagreement::error() const {
    if (signal == 0.0) return 0.0;
    // Two independent values a and b of a bin, each off by s on average, have a mean that is off by
    // s / sqrt(2), and |a - b| is sqrt(2) s on average: the mean is off by half of |a - b|.
    //
    // One set of rays finds a bin with probability p, the other with q, so both miss it with
    // probability (1 - p) (1 - q). The share p (1 - q) of the signal is found by the first set
    // alone, (1 - p) q by the other alone. The root of their product, sqrt(p q (1 - p) (1 - q)), is
    // no less than the missed share when p q >= (1 - p) (1 - q). For p = q it is half of what one
    // set alone finds, as above.
    //
    // In every bin the error is one draw, and half of the difference d is another draw of the same
    // size, so the variance of the difference of their sums is 2 sum (d / 2)^2.
    const double twice_standard_error = std::sqrt(2.0 * squares);
    return (0.5 * difference + std::sqrt(first_alone * second_alone) + twice_standard_error) /
           signal;
}

SetDisagreement of_all_beams(const View& view, const Samples& samples) {
    const auto per_bin = static_cast<float>(1.0 / view.bin_m());
    SetDisagreement out;
    out.occupied.resize(static_cast<std::size_t>(view.beams) * view.range_bins);
    for (int j = 0; j < view.beams; ++j) {
        const auto beam = out.occupied.begin() + std::ptrdiff_t{j} * view.range_bins;
        for (const Sample& sample : samples.beam(j)) {
            const float range = sample.position.norm();
            const float centre = (range - static_cast<float>(view.range_min_m)) * per_bin;
            const float half = half_extent(sample, 1.0F / range, per_bin);
            const OverlappedBins<float> covered(centre - half, centre + half, view.range_bins);
            std::fill(beam + covered.begin, beam + covered.end, std::uint8_t{1});
        }
    }
    return out;
}

SetComparison::SetComparison(const View& view, std::span<const Material> materials)
    : materials_(materials),
      range_min_m_(static_cast<float>(view.range_min_m)),
      per_bin_(static_cast<float>(1.0 / view.bin_m())),
      bins_(view.range_bins),
      begin_(view.range_bins) {
    result_.every = std::max(1, view.beams / most_compared_beams);
    const int compared = (view.beams + result_.every - 1) / result_.every;
    result_.occupied.resize(static_cast<std::size_t>(compared) * view.range_bins);
}

void SetComparison::add_beam(int beam, std::span<const Sample> samples,
                             std::span<const RaySet> sets) {
    if (beam % result_.every != 0) return;
    for (std::size_t i = 0; i < samples.size(); ++i)
        add(samples[i], sets[i]);
    compare_bins(result_.occupied.data() +
                 static_cast<std::size_t>(beam / result_.every) * bins_.size());
}

/// Adds a sample to its bins, as a box in range.
void SetComparison::add(const Sample& sample, RaySet set) {
    const float range = sample.position.norm();
    const float per_range = 1.0F / range;
    const float half = half_extent(sample, per_range, per_bin_);
    const float centre = (range - range_min_m_) * per_bin_;
    const OverlappedBins<float> covered(centre - half, centre + half,
                                        static_cast<int>(bins_.size()));
    if (covered.empty()) return;
    begin_ = std::min(begin_, covered.begin);
    end_ = std::max(end_, covered.end);
    const float density = sample.area_m2 / (2.0F * half);
    const float intensity = materials_[sample.material].reflection * sample.height_m * per_range;
    for (int i = covered.begin; i < covered.end; ++i) {
        Sum& sum = bins_[i][static_cast<std::size_t>(set)];
        const float weight = density * covered.overlap(i);
        sum.weight += weight;
        sum.echo += weight * intensity;
    }
}

void SetComparison::compare_bin(const Bin& bin, SetDisagreement& out) {
    const auto& [both, of_first, of_second, middle, edges] = bin;
    const auto signal = static_cast<double>((both + of_first + of_second + middle + edges).mean());
    out.signal += signal;
    // Strips are a share of a column's width; scaled up, each set represents the whole width.
    const Sum first = of_first + middle.times(1.0F / (1.0F - 2.0F * edge_strip_share));
    const Sum second = of_second + edges.times(0.5F / edge_strip_share);
    if (first.weight == 0.0F && second.weight == 0.0F) return;
    const Sum by_first = both + first;
    const Sum by_second = both + second;
    const auto apart = static_cast<double>(std::fabs(by_first.mean() - by_second.mean()));
    out.squares += apart * apart;
    if (by_second.weight == 0.0F)
        out.first_alone += signal;
    else if (by_first.weight == 0.0F)
        out.second_alone += signal;
    else
        out.difference += apart;
}

/// Compares the bins of a beam and clears them. `occupied` [range bins] of the beam is set.
void SetComparison::compare_bins(std::uint8_t* occupied) {
    for (int i = begin_; i < end_; ++i) {
        Bin& bin = bins_[i];
        if (std::ranges::all_of(bin, [](const Sum& sum) { return sum.weight == 0.0F; })) continue;
        occupied[i] = 1;
        compare_bin(bin, result_);
        bin = {};
    }
    begin_ = static_cast<int>(bins_.size());
    end_ = 0;
}

}  // namespace sonarsim
