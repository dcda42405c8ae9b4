#pragma once

#include <array>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/surface_echoes.h"
#include "simulate/trace/taper.h"

namespace sonarsim {

/// The path of a patch of surface through the range bins.
struct RangePath {
    double range_m;             ///< centre
    double before_m, after_m;   ///< extent in range on either side of the centre
    double depth_m;             ///< extent in range of its half edges
    double bend;                ///< squared length of the way per metre of range
    Eigen::Vector3f per_range;  ///< the way per metre of range, where range grows fastest
};

inline RangePath range_path(const EchoPatch& patch) {
    const auto [range, d] = arrival_of(patch.position);
    const float u = d.dot(patch.edge_u);
    const float v = d.dot(patch.edge_v);
    const RangeExtent along_u = extent_of(patch.edge_u.squaredNorm(), std::fabs(u), range);
    const RangeExtent along_v = extent_of(patch.edge_v.squaredNorm(), std::fabs(v), range);
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    Eigen::Vector3f path = Eigen::Vector3f::Zero();
    if (depth_2 > 0.0) {
        path = (u * patch.edge_u + v * patch.edge_v) / static_cast<float>(depth_2);
    }
    const auto [before, after] = wedge_extent(patch.wedge, u, v);
    return {.range_m = range,
            .before_m = before * (along_u.before + along_v.before),
            .after_m = after * (along_u.after + along_v.after),
            .depth_m = std::max(before, after) * (std::fabs(u) + std::fabs(v)),
            .bend = path.squaredNorm(),
            .per_range = path};
}

/// The length along RangePath::per_range from the centre to the range r, m. Along p + t e, where d
/// . e = 1, the range is r^2 = r_0^2 + 2 r_0 t + e^2 t^2: a flat piece may span many bins, and its
/// way is not linear in range.
inline double way_to(const RangePath& path, double r) {
    const double more = (r - path.range_m) * (r + path.range_m);
    const double root = std::sqrt(std::max(path.range_m * path.range_m + path.bend * more, 0.0));
    return std::clamp(more / (path.range_m + root), -path.depth_m, path.depth_m);
}

struct CoveredBins {
    static constexpr int at_once = 16;
    /// Bins are computed in vectors of this many. Beyond the last one the share is 0.
    static constexpr int lanes = 4;

    int first, count;
    int whole;                          ///< `count`, rounded up to whole vectors
    std::array<double, at_once> share;  ///< share of the footprint, by bin
    /// At the entry into the first bin and the exit of each, or at the ends of the footprint.
    std::array<double, at_once + 1> range_m, way;
};

/// Calls visit(covered) for the bins that the footprint covers; several, so that loops vectorise.
template <class Visit>
void for_each_covered(const RangePath& path, const RangeBins& bins, Visit visit) {
    constexpr int at_once = CoveredBins::at_once;
    constexpr int lanes = CoveredBins::lanes;
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
    covered.range_m[0] = bins.min_m + low * bins.bin_m;
    covered.way[0] = way_to(path, covered.range_m[0]);
    for (int from = first_bin; from < end_bin; from += at_once) {
        covered.first = from;
        covered.count = std::min(at_once, end_bin - from);
        covered.whole = (covered.count + lanes - 1) / lanes * lanes;
        // Two loops vectorise; one would not.
        const auto start = static_cast<double>(from);
        for (int k = 0; k < covered.whole; ++k) {
            const double enters = std::max(low, start + k);
            const double leaves = std::min(high, start + k + 1.0);
            covered.range_m[k + 1] = bins.min_m + leaves * bins.bin_m;
            covered.share[k] = std::max((leaves - enters) / (last - first), 0.0);
        }
        for (int k = 0; k < covered.whole; ++k)
            covered.way[k + 1] = way_to(path, covered.range_m[k + 1]);
        visit(covered);
        covered.range_m[0] = covered.range_m[covered.count];
        covered.way[0] = covered.way[covered.count];
    }
}

/// The echo of each bin of some rows, and its moments: the sums of echoes times what `moment_` has
/// of their patch. With places for whole vectors of CoveredBins beyond the last bin.
template <std::size_t moments>
class BinMoments {
  public:
    BinMoments(int rows, int bins)
        : stride_(static_cast<std::size_t>(bins) + CoveredBins::lanes),
          reached_(rows, {bins, 0}),
          bins_(bins) {
        for (std::vector<double>& all : sums_)
            all.resize(static_cast<std::size_t>(rows) * stride_);
    }

    void add(std::uint32_t row, double echo, const CoveredBins& covered) {
        Reached& reached = reached_[row];
        reached.first = std::min(reached.first, covered.first);
        reached.last = std::max(reached.last, covered.first + covered.count);
        const std::size_t at = row * stride_ + covered.first;
        double* const __restrict sum = sums_[0].data() + at;
        std::array<double, CoveredBins::at_once> parts;
        for (int k = 0; k < covered.whole; ++k) {
            parts[k] = echo * covered.share[k];
            sum[k] += parts[k];
        }
        for (std::size_t n = 0; n < moments; ++n) {
            double* const __restrict moment = sums_[n + 1].data() + at;
            for (int k = 0; k < covered.whole; ++k)
                moment[k] += parts[k] * moment_[n][k];
        }
    }

  protected:
    using Sums = std::array<double*, moments + 1>;  ///< the echo and its moments, by bin

    /// Calls use(first, last, sums) with a row, 0 outside of bins [first, last), and clears it.
    template <class Use>
    void take(std::uint32_t row, Use use) {
        const auto [first, last] = reached_[row];
        Sums sums;
        for (std::size_t n = 0; n <= moments; ++n)
            sums[n] = sums_[n].data() + row * stride_;
        use(first, last, sums);
        for (double* const sum : sums)
            std::fill(sum + first, sum + std::max(first, last), 0.0);
        reached_[row] = {bins_, 0};
    }

    /// [moments] for the covered bins of the patch.
    std::array<std::array<double, CoveredBins::at_once>, moments> moment_{};

  private:
    struct Reached {
        int first, last;
    };

    std::size_t stride_;
    /// Doubles, since a spread is a small difference of squares.
    std::array<std::vector<double>, moments + 1> sums_;
    std::vector<Reached> reached_;
    int bins_;
};

}  // namespace sonarsim
