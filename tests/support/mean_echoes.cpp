#include "support/mean_echoes.h"

#include <algorithm>
#include <cmath>

namespace sonarsim::test {

namespace {

/// The bins [i, i + 1), i from 0 to count - 1, that an interval overlaps. All lengths are in bins.
struct OverlappedBins {
    double from, to;  ///< the interval, clipped to the bins
    int begin = 0;    ///< the first bin
    int end = 0;      ///< one behind the last bin; equal to `begin` if there is none

    OverlappedBins(double low, double high, int count)
        : from(std::max(low, 0.0)), to(std::min(high, static_cast<double>(count))) {
        if (!(from < to)) return;
        begin = static_cast<int>(from);
        end = std::min(static_cast<int>(std::ceil(to)), count);
    }

    double overlap(int i) const {
        return std::min(to, static_cast<double>(i + 1)) - std::max(from, static_cast<double>(i));
    }
};

/// Sums over the samples in each bin of a beam. Their quotient is the mean echo.
struct BeamSums {
    std::vector<double> weight;
    std::vector<double> echo;

    double mean(int bin) const { return weight[bin] > 0.0 ? echo[bin] / weight[bin] : 0.0; }
};

/// Spreads a sample over the bins that it covers, in proportion to the overlap.
void spread_sample(const Sample& sample, double reflection, const View& view, BeamSums& sums) {
    const double range = static_cast<double>(sample.position.norm());
    const double half = static_cast<double>(std::fabs(sample.position.dot(sample.edge_u)) +
                                            std::fabs(sample.position.dot(sample.edge_v))) /
                        range;
    const double bin = view.bin_m();
    const double low = (range - half - view.range_min_m) / bin;
    const double high = std::max((range + half - view.range_min_m) / bin, low + 1e-6);
    const double density = static_cast<double>(sample.area_m2) / (high - low);
    const double intensity = reflection * static_cast<double>(sample.strength) *
                             static_cast<double>(sample.height_m) / range;
    const OverlappedBins bins(low, high, view.range_bins);
    for (int i = bins.begin; i < bins.end; ++i) {
        sums.weight[i] += density * bins.overlap(i);
        sums.echo[i] += density * bins.overlap(i) * intensity;
    }
}

BeamSums sum_beam(const Scene& scene, const View& view, const Samples& samples, int beam) {
    BeamSums sums{std::vector<double>(view.range_bins), std::vector<double>(view.range_bins)};
    for (const Sample& sample : samples.beam(beam))
        spread_sample(sample, static_cast<double>(scene.materials[sample.material].reflection),
                      view, sums);
    return sums;
}

}  // namespace

std::vector<double> mean_echoes(const Scene& scene, const View& view, const Samples& samples) {
    std::vector<double> image;
    image.reserve(static_cast<std::size_t>(view.beams) * view.range_bins);
    for (int beam = 0; beam < view.beams; ++beam) {
        const BeamSums sums = sum_beam(scene, view, samples, beam);
        for (int bin = 0; bin < view.range_bins; ++bin)
            image.push_back(sums.mean(bin));
    }
    return image;
}

}  // namespace sonarsim::test
