#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "trace/surface_echoes.h"

namespace sonarsim {

/// A patch of surface as a way through the bins, and how far it rises along an axis.
struct RangePath {
    double range_m, rise_m;    ///< centre; the rise is relative to the sensor
    double before_m, after_m;  ///< extent of its range on either side
    double depth_m;            ///< spanned by its half edges
    double bend;               ///< squared length of the way per metre of range
    double slope;              ///< rise per metre of range, where range grows fastest
};

/// `axis` is a unit vector in the sensor's frame.
RangePath range_path(const EchoPatch& patch, const Eigen::Vector3f& axis);

/// The rise of the footprint at range r. Along p + t e, where d . e = 1, the range is
/// r^2 = r_0^2 + 2 r_0 t + e^2 t^2: a flat piece may span many bins, and its rise is not linear.
inline double rise_at(const RangePath& path, double r) {
    const double more = (r - path.range_m) * (r + path.range_m);
    const double root = std::sqrt(std::max(path.range_m * path.range_m + path.bend * more, 0.0));
    const double t = std::clamp(more / (path.range_m + root), -path.depth_m, path.depth_m);
    return path.rise_m + path.slope * t;
}

/// Successive bins that a footprint covers.
struct CoveredBins {
    static constexpr int at_once = 16;

    int first, count;
    std::array<double, at_once> share;  ///< share of the footprint, by bin
    std::array<double, at_once + 1>
        values;  ///< at the entry into the first bin and the exit of each
};

/// Calls visit(covered) for the bins that the footprint covers, in order, with the values of
/// value_at(r) at their borders or its ends. They are worked out for some bins at a time: then
/// compilers make vectors of value_at().
template <class ValueAt, class Visit>
void for_each_covered(const RangePath& path, const RangeBins& bins, ValueAt value_at, Visit visit) {
    constexpr int at_once = CoveredBins::at_once;
    const double per_bin = 1.0 / bins.bin_m;
    const double centre = (path.range_m - bins.min_m) * per_bin;
    // As in accumulate(): a footprint without depth still needs a width.
    const double first = centre - std::max(path.before_m * per_bin, 1e-3);
    const double last = centre + std::max(path.after_m * per_bin, 1e-3);
    const double low = std::max(first, 0.0);
    const double high = std::min(last, static_cast<double>(bins.count));
    if (!(low < high)) return;
    const auto first_bin = static_cast<int>(low);
    const int end_bin = std::min(static_cast<int>(std::ceil(high)), bins.count);
    CoveredBins covered;
    covered.values[0] = value_at(bins.min_m + low * bins.bin_m);
    for (int from = first_bin; from < end_bin; from += at_once) {
        covered.first = from;
        covered.count = std::min(at_once, end_bin - from);
        // Whole vectors: what is worked out beyond the last bin is not looked at.
        const int whole = (covered.count + 3) & ~3;
        for (int k = 0; k < whole; ++k) {
            const double enters = std::max(low, static_cast<double>(from + k));
            const double leaves = std::min(high, from + k + 1.0);
            covered.values[k + 1] = value_at(bins.min_m + leaves * bins.bin_m);
            covered.share[k] = (leaves - enters) / (last - first);
        }
        visit(covered);
        covered.values[0] = covered.values[covered.count];
    }
}

}  // namespace sonarsim
