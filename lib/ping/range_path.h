#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "ping/accumulate.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The footprint of a sample as a way through the bins, and how far it rises along an axis.
struct RangePath {
    double range_m, rise_m;    ///< of its centre; the rise is counted from the sensor
    double before_m, after_m;  ///< how far its range reaches from there
    double depth_m;            ///< spanned by its half edges
    double bend;               ///< squared length of the way per metre of range
    double slope;              ///< rise per metre of range, where range grows fastest
};

/// `axis` is a unit vector in the sensor's frame.
RangePath range_path(const Sample& sample, const Eigen::Vector3f& axis);

/// How far the footprint has risen at range r. On its way p + t e, where d . e = 1, the range is
/// r^2 = r_0^2 + 2 r_0 t + e^2 t^2: a flat piece may span many bins, and its rise is not linear.
double rise_at(const RangePath& path, double r);

/// Area times intensity of a sample, the numerator of Eq. 9.
double echo_of(const Sample& sample, double range_m, const Material& material);

/// Calls visit(bin, share, value_from, value_to) for the bins that the footprint covers, with the
/// share of it in the bin and the values of value_at(r) at the ranges where it enters and leaves.
template <class ValueAt, class Visit>
void for_each_bin(const RangePath& path, const RangeBins& bins, ValueAt value_at, Visit visit) {
    const double per_bin = 1.0 / bins.bin_m;
    const double centre = (path.range_m - bins.min_m) * per_bin;
    // As in accumulate(): a footprint without depth still needs a width.
    const double first = centre - std::max(path.before_m * per_bin, 1e-3);
    const double last = centre + std::max(path.after_m * per_bin, 1e-3);
    const double low = std::max(first, 0.0);
    const double high = std::min(last, static_cast<double>(bins.count));
    if (!(low < high)) return;
    double value_from = value_at(bins.min_m + low * bins.bin_m);
    for (auto i = static_cast<int>(low); i < bins.count && i < high; ++i) {
        const double from = std::max(low, static_cast<double>(i));
        const double to = std::min(high, i + 1.0);
        const double value_to = value_at(bins.min_m + to * bins.bin_m);
        visit(i, (to - from) / (last - first), value_from, value_to);
        value_from = value_to;
    }
}

}  // namespace sonarsim
