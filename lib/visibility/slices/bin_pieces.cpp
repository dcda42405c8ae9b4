#include "visibility/slices/bin_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/groups.h"
#include "visibility/view_volume.h"

namespace sonarsim {

namespace {

// Pieces of a ping at most; they take 12 MB. Chosen.
constexpr std::size_t most_pieces_of_ping = 1U << 18U;

// Tolerance at borders, in bins, beams or heights of the view.
constexpr double border_rounding = 1e-4;

// Largest deviation of a line of equal range from a straight line, in bins. Chosen.
constexpr float straight_within = 0.25F;

using Corners3 = std::array<Eigen::Vector3f, 3>;

/// The places of three corners: whole numbers are borders.
using Places = std::array<double, 3>;

/// Cuts a part at each border between its corners, beginning with a middle one. Calls `whole` with
/// each piece and the number of the interval that holds it, from 0 to `intervals` - 1, and drops
/// pieces outside. `crossing` gives the point of a side at a border.
template <typename Crossing, typename Whole>
void cut_at_borders(const Corners3& part, const Places& at, int intervals, const Crossing& crossing,
                    const Whole& whole) {
    const auto [low, high] = std::minmax({at[0], at[1], at[2]});
    // A part that reaches in only by rounding has no border to cut at.
    if (!(high > border_rounding && low < intervals - border_rounding)) return;
    const double first = std::floor(low + border_rounding) + 1.0;
    if (!(high > first + border_rounding)) {
        const int interval = static_cast<int>(std::floor(0.5 * (low + high)));
        if (interval >= 0 && interval < intervals) whole(part, interval);
        return;
    }
    const double middle =
        std::clamp(std::round(0.5 * (low + high)), 0.0, static_cast<double>(intervals));
    const bool between = middle > low + border_rounding && middle < high - border_rounding;
    const double level = between ? middle : first;
    // One corner lies alone on its side.
    int alone = 0;
    for (int k = 0; k < 3; ++k) {
        const bool above = at[k] > level;
        if (above != (at[(k + 1) % 3] > level) && above != (at[(k + 2) % 3] > level)) alone = k;
    }
    const int left = (alone + 1) % 3;
    const int right = (alone + 2) % 3;
    const Eigen::Vector3f to_left = crossing(part[alone], part[left], level);
    const Eigen::Vector3f to_right = crossing(part[alone], part[right], level);
    const auto cut = [&](const Corners3& corners, const Places& places) {
        cut_at_borders(corners, places, intervals, crossing, whole);
    };
    cut({part[alone], to_left, to_right}, {at[alone], level, level});
    cut({to_left, part[left], part[right]}, {level, at[left], at[right]});
    cut({to_left, part[right], to_right}, {level, at[right], level});
}

/// The point at a share of the side from a to b.
Eigen::Vector3f at_share(const Eigen::Vector3f& a, const Eigen::Vector3f& b, double share) {
    return a + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (b - a);
}

/// Cuts triangles at the borders of beams, then into parts on which lines of equal range are
/// straight, and these parts at the borders of the view and of bins. Sensor frame.
class PieceCutter {
  public:
    explicit PieceCutter(const View& view)
        : view_(view),
          volume_(view, Pose{}),
          bin_m_(static_cast<float>(view.bin_m())),
          range_min_m_(static_cast<float>(view.range_min_m)) {
        const SinCos greatest = sincos(0.5 * view.elevation_rad);
        steepest_ = greatest.sin / std::max(greatest.cos, 1e-6);
        if (view.shape == ViewShape::cone) return;
        for (int k = 0; k <= view.beams; ++k)
            borders_.push_back(
                sincos((static_cast<double>(k) / view.beams - 0.5) * view.azimuth_rad));
    }

    bool may_be_in_view(const Eigen::Vector3f& centre, float radius) const {
        return centre.norm() + radius >= range_min_m_ &&
               volume_.of_sensor_frame(centre, radius) != Containment::outside;
    }

    /// False if there are too many pieces.
    bool cut(const Corners3& triangle, std::uint32_t facet) {
        halve(triangle, [&](const Corners3& part, float) {
            if (view_.shape == ViewShape::cone) {
                into_bins(part, 0, facet);
                return true;
            }
            const Places at{beam_at(part[0]), beam_at(part[1]), beam_at(part[2])};
            const auto [low, high] = std::minmax({at[0], at[1], at[2]});
            // Parts about the vertical, or behind the sonar, span more than a quarter of a turn.
            if ((high - low) * view_.azimuth_rad > 0.5 * pi * view_.beams) return false;
            const auto crossing = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                      double level) { return at_beam(a, b, level); };
            cut_at_borders(part, at, view_.beams, crossing,
                           [&](const Corners3& strip, int beam) { into_bins(strip, beam, facet); });
            return true;
        });
        return pieces.size() <= most_pieces_of_ping;
    }

    std::vector<BinPiece> pieces;
    std::vector<std::uint32_t> bin_of;  ///< [beams, range_bins] index of each piece

  private:
    /// Halves the longest side of the parts of a triangle until `take` accepts them. Drops parts
    /// out of view.
    template <typename Take>
    void halve(const Corners3& triangle, const Take& take) const {
        std::vector<Corners3> left{triangle};
        while (!left.empty()) {
            const Corners3 part = left.back();
            left.pop_back();
            const Eigen::Vector3f middle = (part[0] + part[1] + part[2]) / 3.0F;
            const std::array<float, 3> sides{(part[1] - part[0]).norm(), (part[2] - part[1]).norm(),
                                             (part[0] - part[2]).norm()};
            const int longest = static_cast<int>(std::ranges::max_element(sides) - sides.begin());
            // The middle is at most two thirds of a median from a corner.
            if (!may_be_in_view(middle, sides[longest] * (2.0F / 3.0F))) continue;
            // Parts at the sonar never become small compared with their range.
            if (take(part, sides[longest]) || sides[longest] < 0.1F * bin_m_) continue;
            const Eigen::Vector3f& a = part[longest];
            const Eigen::Vector3f& b = part[(longest + 1) % 3];
            const Eigen::Vector3f& c = part[(longest + 2) % 3];
            const Eigen::Vector3f half = 0.5F * (a + b);
            left.push_back({a, half, c});
            left.push_back({half, b, c});
        }
    }

    /// Cuts a part within one beam.
    void into_bins(const Corners3& strip, int beam, std::uint32_t facet) {
        halve(strip, [&](const Corners3& part, float side) {
            if (pieces.size() > most_pieces_of_ping) return true;
            if (!is_straight(part, side)) return false;
            const auto crossing = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                      double level) { return at_elevation(a, b, level); };
            cut_at_borders(
                part, {elevation_at(part[0]), elevation_at(part[1]), elevation_at(part[2])}, 1,
                crossing, [&](const Corners3& inside, int) { at_ranges(inside, beam, facet); });
            return true;
        });
    }

    void at_ranges(const Corners3& part, int beam, std::uint32_t facet) {
        const auto place = [&](const Eigen::Vector3f& point) {
            return (static_cast<double>(point.norm()) - view_.range_min_m) / view_.bin_m();
        };
        const auto crossing = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                  double level) { return at_range(a, b, level); };
        cut_at_borders(
            part, {place(part[0]), place(part[1]), place(part[2])}, view_.range_bins, crossing,
            [&](const Corners3& piece, int bin) {
                const float area = 0.5F * (piece[1] - piece[0]).cross(piece[2] - piece[0]).norm();
                if (!(area > 0.0F)) return;
                pieces.push_back({piece, area, facet});
                bin_of.push_back(static_cast<std::uint32_t>(beam * view_.range_bins + bin));
            });
    }

    /// True if lines of equal range on a part are nearly straight: a chord of length e at range r
    /// is off by at most e^2 / (8 r). On parts of a quarter of a cone's width its border is
    /// straight within 1/32 of its radius.
    bool is_straight(const Corners3& part, float side) const {
        const float range = part[0].norm();
        const float widest = 0.25F * static_cast<float>(view_.azimuth_rad) * range;
        if (view_.shape == ViewShape::cone && side > widest) return false;
        return side * side <= 8.0F * straight_within * bin_m_ * range;
    }

    double beam_at(const Eigen::Vector3f& point) const {
        return (arctan2(point.y(), point.x()) / view_.azimuth_rad + 0.5) * view_.beams;
    }

    /// The point of a side at a border between beams, a half plane through the z axis.
    Eigen::Vector3f at_beam(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                            double level) const {
        const SinCos& border = borders_[static_cast<std::size_t>(level)];
        const double of_a = a.y() * border.cos - a.x() * border.sin;
        const double of_b = b.y() * border.cos - b.x() * border.sin;
        return at_share(a, b, of_a / (of_a - of_b));
    }

    /// 0 at the view's lower border and 1 at the upper one; for a cone 0.5 on its axis and 1 at its
    /// border.
    double elevation_at(const Eigen::Vector3f& point) const {
        if (view_.shape == ViewShape::cone) {
            const double ahead = std::max(static_cast<double>(point.x()), 1e-9);
            return 0.5 + 0.5 * static_cast<double>(point.tail<2>().norm()) / (ahead * steepest_);
        }
        const double ground = std::max(static_cast<double>(point.head<2>().norm()), 1e-9);
        return 0.5 + 0.5 * static_cast<double>(point.z()) / (ground * steepest_);
    }

    /// The point of a side at a border of elevation, which is a cone, by regula falsi:
    /// elevation_at() is nearly linear along the side.
    Eigen::Vector3f at_elevation(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                 double level) const {
        constexpr int steps = 4;
        double from = 0.0;
        double to = 1.0;
        double at_from = elevation_at(a) - level;
        double at_to = elevation_at(b) - level;
        double share = 0.5;
        for (int step = 0; step < steps; ++step) {
            share = from + (to - from) * at_from / (at_from - at_to);
            const double at = elevation_at(at_share(a, b, share)) - level;
            if (std::fabs(at) < border_rounding) break;
            const bool beyond = (at > 0.0) == (at_to > 0.0);
            (beyond ? to : from) = share;
            (beyond ? at_to : at_from) = at;
        }
        return at_share(a, b, share);
    }

    /// The point of a side at a border of range, which is a sphere: |a + s (b - a)|^2 = R^2 has one
    /// root on the side if one end is inside.
    Eigen::Vector3f at_range(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                             double level) const {
        const double range = view_.range_min_m + level * view_.bin_m();
        const Eigen::Vector3d from = a.cast<double>();
        const Eigen::Vector3d way = b.cast<double>() - from;
        const double square = way.squaredNorm();
        const double half = from.dot(way);
        const double left = from.squaredNorm() - range * range;
        const double root = std::sqrt(std::max(half * half - square * left, 0.0));
        // From within the sphere outward, or from outside inward.
        const double share =
            left < 0.0 ? -left / std::max(half + root, 1e-30) : left / std::max(root - half, 1e-30);
        return at_share(a, b, share);
    }

    const View& view_;
    const ViewVolume volume_;
    const float bin_m_;
    const float range_min_m_;
    double steepest_;              ///< tangent of the greatest elevation
    std::vector<SinCos> borders_;  ///< azimuths of the beams' borders
};

/// Sorts pieces by their bins.
BinPieces sorted(const std::vector<BinPiece>& pieces, const std::vector<std::uint32_t>& bin_of,
                 std::size_t all_bins) {
    const Groups groups = sort_into_groups(bin_of, all_bins);
    BinPieces out;
    out.pieces.reserve(pieces.size());
    for (std::size_t bin = 0; bin < all_bins; ++bin) {
        if (groups.begin[bin] == groups.begin[bin + 1]) continue;
        out.bins.push_back(static_cast<std::uint32_t>(bin));
        out.begin.push_back(groups.begin[bin]);
    }
    out.begin.push_back(static_cast<std::uint32_t>(pieces.size()));
    for (const std::uint32_t k : groups.items)
        out.pieces.push_back(pieces[k]);
    out.area_m2.assign(out.bins.size(), 0.0F);
    for (std::size_t k = 0; k < out.bins.size(); ++k) {
        for (std::uint32_t i = out.begin[k]; i < out.begin[k + 1]; ++i)
            out.area_m2[k] += out.pieces[i].area_m2;
    }
    return out;
}

}  // namespace

std::optional<BinPieces> bin_pieces(const ClusterMesh& mesh, const View& view,
                                    const LocalPose& pose) {
    PieceCutter cutter(view);
    const auto in_sensor = [&](const Eigen::Vector3f& local) -> Eigen::Vector3f {
        return pose.rotation.transpose() * (local - pose.position);
    };
    for (const TriangleCluster& cluster : mesh.clusters) {
        if (!cutter.may_be_in_view(in_sensor(cluster.centre), cluster.radius_m)) continue;
        for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
            const std::uint32_t facet = cluster.first_triangle + i;
            Corners3 corners;
            for (int k = 0; k < 3; ++k)
                corners[k] =
                    in_sensor(mesh.vertices[cluster.first_vertex + mesh.corners[facet][k]]);
            if (!cutter.cut(corners, facet)) return std::nullopt;
        }
    }
    const auto bins =
        static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.range_bins);
    return sorted(cutter.pieces, cutter.bin_of, bins);
}

}  // namespace sonarsim
