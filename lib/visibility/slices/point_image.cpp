#include "visibility/slices/point_image.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/elementary.h"
#include "core/random.h"
#include "visibility/slices/patch_limits.h"

namespace sonarsim {

namespace {

constexpr PhiloxKey point_key{0x706f696eU, 0x62696e73U};

// The number of points of each bin in the first draw, and the total after which no more are drawn.
// Chosen.
constexpr std::uint32_t first_points = 16;
constexpr std::size_t enough_points = 1U << 18U;
constexpr std::size_t enough_points_coarse = 1U << 15U;

// The noise of the image, as a share of the view's goal. Chosen.
constexpr double noise_share = 0.25;

// The share of the points that is spread evenly over all bins, visible or hidden. Chosen.
constexpr double even_share = 0.1;

// A bin with fewer points than this does not show its variance. The standard deviation of its
// echoes is taken as this share of their mean. Chosen.
constexpr double fewest_points = 16.0;
constexpr double assumed_deviation = 0.5;

// A ray that meets surface nearer than its point by more than this share of the range is blocked.
constexpr float blocked_share = 1e-5F;

/// A point of the surface on its way to the caster.
struct DrawnPoint {
    std::uint32_t drawn_in;
    std::uint32_t bin;
    float range_m;
    float echo;
};

/// Draws points in bins and casts rays to them.
class PointCaster {
  public:
    PointCaster(const Scene& scene, const ClusterMesh& mesh, const Caster& caster, const View& view,
                const LocalPose& pose, const BinPieces& pieces)
        : scene_(scene), mesh_(mesh), caster_(caster), view_(view), pose_(pose), pieces_(pieces) {}

    /// Draws `count` points in bin k, evenly over the area of its pieces, after `drawn` earlier
    /// points. Calls `seen` with each visible point, now or in a later draw() or cast().
    template <typename Sink>
    void draw(std::uint32_t k, std::uint32_t drawn, std::uint32_t count, const Sink& seen) {
        const auto first = pieces_.pieces.begin() + pieces_.begin[k];
        const auto last = pieces_.pieces.begin() + pieces_.begin[k + 1];
        const float step = pieces_.area_m2[k] / static_cast<float>(count);
        auto piece = first;
        float passed_m2 = 0.0F;
        for (std::uint32_t i = 0; i < count; ++i) {
            const PhiloxBlock random = philox({drawn + i, pieces_.bins[k], 0, 0}, point_key);
            const float at_m2 = (static_cast<float>(i) + unit_float(random.x0)) * step;
            while (piece + 1 != last && passed_m2 + piece->area_m2 < at_m2)
                passed_m2 += (piece++)->area_m2;
            add(*piece, k, unit_float(random.x1), unit_float(random.x2));
            if (directions_.size() == together) cast(seen);
        }
    }

    /// Casts the rays that are left.
    template <typename Sink>
    void cast(const Sink& seen) {
        met_.resize(directions_.size());
        caster_.cast(pose_.position, directions_, 1.01F * static_cast<float>(view_.range_max_m),
                     met_);
        for (std::size_t i = 0; i < met_.size(); ++i) {
            if (met_[i] == Caster::nothing) continue;
            const Facet facet = caster_.facet(met_[i]);
            const float range =
                facet.normal.dot(facet.vertex - pose_.position) / facet.normal.dot(directions_[i]);
            if (range >= points_[i].range_m * (1.0F - blocked_share)) seen(points_[i]);
        }
        directions_.clear();
        points_.clear();
    }

  private:
    static constexpr std::size_t together = 4096;

    void add(const BinPiece& piece, std::uint32_t k, float s, float t) {
        if (s + t > 1.0F) {
            s = 1.0F - s;
            t = 1.0F - t;
        }
        const auto& [a, b, c] = piece.corners;
        const Eigen::Vector3f point = a + s * (b - a) + t * (c - a);
        const float range = point.norm();
        const double bin =
            std::floor((static_cast<double>(range) - view_.range_min_m) / view_.bin_m());
        const auto beam = static_cast<int>(pieces_.bins[k]) / view_.range_bins;
        if (!(bin >= 0.0 && bin < view_.range_bins)) return;
        const SliceFacet& facet = mesh_.facets[piece.facet];
        const Eigen::Vector3f direction = pose_.rotation * (point / range);
        const float echo =
            std::fabs(facet.normal.dot(direction)) * scene_.materials[facet.material].reflection;
        directions_.push_back(direction);
        points_.push_back(
            {k,
             static_cast<std::uint32_t>(beam * view_.range_bins) + static_cast<std::uint32_t>(bin),
             range, echo});
    }

    const Scene& scene_;
    const ClusterMesh& mesh_;
    const Caster& caster_;
    const View& view_;
    const LocalPose& pose_;
    const BinPieces& pieces_;
    std::vector<Eigen::Vector3f> directions_;  ///< scene-local frame
    std::vector<DrawnPoint> points_;
    std::vector<std::uint32_t> met_;
};

}  // namespace

double PointImage::Bin::deviation() const {
    if (!(points > 0.0)) return 0.0;
    const double squares = area2_echo2 - 2.0 * mean() * area2_echo + mean() * mean() * area2;
    const double known = std::sqrt(std::max(squares, 0.0)) / area;
    if (points >= fewest_points) return known;
    return std::max(known, assumed_deviation * mean() / std::sqrt(points));
}

PointImage::PointImage(const Scene& scene, const ClusterMesh& mesh, const Caster& caster,
                       const View& view, const LocalPose& pose)
    : bins_(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.range_bins)) {
    const std::optional<BinPieces> pieces = bin_pieces(mesh, view, pose);
    if (!pieces || pieces->bins.empty()) return;
    const double goal = view.relative_l1;
    const std::size_t enough = is_coarse(goal) ? enough_points_coarse : enough_points;
    PointCaster caster_of_points(scene, mesh, caster, view, pose, *pieces);
    std::vector<Seen> seen;
    const auto keep = [&](const DrawnPoint& point) {
        seen.push_back({point.drawn_in, point.bin, point.echo});
    };
    std::vector<std::uint32_t> drawn(pieces->bins.size(), 0);
    std::vector<std::uint32_t> counts(pieces->bins.size(), first_points);
    std::size_t points = 0;
    while (true) {
        for (std::uint32_t k = 0; k < drawn.size(); ++k) {
            if (counts[k] <= drawn[k]) continue;
            caster_of_points.draw(k, drawn[k], counts[k] - drawn[k], keep);
            points += counts[k] - drawn[k];
            drawn[k] = counts[k];
        }
        caster_of_points.cast(keep);
        const double noise = sum_up(*pieces, drawn, seen);
        if (noise <= noise_share * goal * signal_ || points >= enough) return;
        counts = target_counts(*pieces, drawn, 2.0 * static_cast<double>(points));
    }
}

double PointImage::sum_up(const BinPieces& pieces, std::span<const std::uint32_t> drawn,
                          std::span<const Seen> seen) {
    std::ranges::fill(bins_, Bin{});
    for (std::size_t k = 0; k < drawn.size(); ++k)
        bins_[pieces.bins[k]].area_per_point = static_cast<double>(pieces.area_m2[k]) / drawn[k];
    for (const Seen& point : seen) {
        Bin& bin = bins_[point.bin];
        const double w = bins_[pieces.bins[point.drawn_in]].area_per_point;
        const auto x = static_cast<double>(point.echo);
        bin.points += 1.0;
        bin.area += w;
        bin.echo += w * x;
        bin.area2 += w * w;
        bin.area2_echo += w * w * x;
        bin.area2_echo2 += w * w * x * x;
    }
    signal_ = 0.0;
    double deviations = 0.0;
    for (const Bin& bin : bins_) {
        signal_ += bin.mean();
        deviations += bin.deviation();
    }
    return deviations;
}

std::vector<std::uint32_t> PointImage::target_counts(const BinPieces& pieces,
                                                     std::span<const std::uint32_t> drawn,
                                                     double all) const {
    std::vector<double> share(drawn.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < share.size(); ++k) {
        const double of_one_point = bins_[pieces.bins[k]].deviation() * std::sqrt(drawn[k]);
        share[k] = of_one_point > 0.0 ? power(of_one_point, 2.0 / 3.0) : 0.0;
        sum += share[k];
    }
    std::vector<std::uint32_t> counts(drawn.size());
    for (std::size_t k = 0; k < share.size(); ++k) {
        const double evenly = even_share / static_cast<double>(share.size());
        const double part = evenly + (sum > 0.0 ? (1.0 - even_share) * share[k] / sum : 0.0);
        counts[k] = static_cast<std::uint32_t>(std::ceil(all * part));
    }
    return counts;
}

bool PointImage::may_be_missed(std::size_t k, const SampledImage& image, EdgeBin edge) const {
    const auto area = static_cast<double>(image.area[k]);
    if (bins_[k].points > 0.0 || !(area > 0.0)) return false;
    return edge == EdgeBin::filled || area < fewest_points * bins_[k].area_per_point;
}

double PointImage::error_of(const SampledImage& image, std::span<const EdgeBin> edges) const {
    if (!(signal_ > 0.0)) return 0.0;
    double error = 0.0;
    for (std::size_t k = 0; k < bins_.size(); ++k) {
        if (may_be_missed(k, image, edges[k])) continue;
        const double difference = static_cast<double>(image.intensity(k)) - bins_[k].mean();
        const double deviation = bins_[k].deviation();
        error += std::sqrt(std::max(difference * difference - deviation * deviation, 0.0));
    }
    return error / signal_;
}

}  // namespace sonarsim
