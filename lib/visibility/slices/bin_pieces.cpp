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

// In bins: the borders of bins are met within this.
constexpr double border_rounding = 1e-4;

// Small parts span fewer places than this; those about an axis of the angles are not cut. Chosen.
constexpr double most_places = 64.0;

// In bins: lines of equal range may be off by this. Chosen.
constexpr float straight_within = 0.25F;

/// The borders at which parts are cut.
enum class BinBorder { beam, elevation, range };

using Corners3 = std::array<Eigen::Vector3f, 3>;

/// Cuts triangles by halving their longest side. Sensor frame.
class PieceCutter {
  public:
    explicit PieceCutter(const View& view)
        : view_(view),
          volume_(view, Pose{}),
          bin_m_(static_cast<float>(view.bin_m())),
          range_min_m_(static_cast<float>(view.range_min_m)),
          // A view is wide in one angle and a beam in the other.
          widest_rad_(static_cast<float>(std::min(
              view.elevation_rad,
              view.shape == ViewShape::fan ? view.azimuth_rad / view.beams : view.azimuth_rad))) {}

    bool may_be_in_view(const Eigen::Vector3f& centre, float radius) const {
        return centre.norm() + radius >= range_min_m_ &&
               volume_.of_sensor_frame(centre, radius) != Containment::outside;
    }

    /// False if there are too many pieces.
    bool cut(const Corners3& triangle, std::uint32_t facet) {
        left_ = {triangle};
        while (!left_.empty()) {
            const Corners3 part = left_.back();
            left_.pop_back();
            const Eigen::Vector3f middle = (part[0] + part[1] + part[2]) / 3.0F;
            const std::array<float, 3> sides{(part[1] - part[0]).norm(), (part[2] - part[1]).norm(),
                                             (part[0] - part[2]).norm()};
            const int longest = static_cast<int>(std::ranges::max_element(sides) - sides.begin());
            // The middle is at most two thirds of a median from a corner.
            if (!may_be_in_view(middle, sides[longest] * (2.0F / 3.0F))) continue;
            if (is_small(middle, sides[longest])) {
                cut_at(BinBorder::beam, part, facet);
                if (pieces.size() > most_pieces_of_ping) return false;
                continue;
            }
            const Eigen::Vector3f& a = part[longest];
            const Eigen::Vector3f& b = part[(longest + 1) % 3];
            const Eigen::Vector3f& c = part[(longest + 2) % 3];
            const Eigen::Vector3f half = 0.5F * (a + b);
            left_.push_back({a, half, c});
            left_.push_back({half, b, c});
        }
        return true;
    }

    std::vector<BinPiece> pieces;
    std::vector<std::uint32_t> bin_of;  ///< [beams, range_bins] index of each piece

  private:
    /// True if a part is not wider than a beam and lines of equal range on it are nearly straight:
    /// a chord of length e at range r is off by at most e^2 / (8 r).
    bool is_small(const Eigen::Vector3f& middle, float side) const {
        const float range = middle.norm();
        return side <= widest_rad_ * range &&
               side * side <= 8.0F * straight_within * bin_m_ * range;
    }

    double beam_at(const Eigen::Vector3f& point) const {
        if (view_.shape == ViewShape::cone) return 0.5;
        return (arctan2(point.y(), point.x()) / view_.azimuth_rad + 0.5) * view_.beams;
    }

    double range_bin(const Eigen::Vector3f& point) const {
        return (static_cast<double>(point.norm()) - view_.range_min_m) / view_.bin_m();
    }

    /// The share of the view's elevation, or of a cone's half opening.
    double elevation_at(const Eigen::Vector3f& point) const {
        if (view_.shape == ViewShape::cone)
            return arctan2(point.tail<2>().norm(), point.x()) / (0.5 * view_.azimuth_rad);
        return arctan2(point.z(), point.head<2>().norm()) / view_.elevation_rad + 0.5;
    }

    double place(BinBorder border, const Eigen::Vector3f& point) const {
        switch (border) {
            case BinBorder::beam:
                return beam_at(point);
            case BinBorder::elevation:
                return elevation_at(point);
            default:
                return range_bin(point);
        }
    }

    int places(BinBorder border) const {
        switch (border) {
            case BinBorder::beam:
                return view_.beams;
            case BinBorder::elevation:
                return 1;
            default:
                return view_.range_bins;
        }
    }

    /// Cuts a small part at all borders of one kind that it crosses, beginning with a middle one.
    void cut_at(BinBorder border, const Corners3& part, std::uint32_t facet) {
        cut_at(border, part,
               {place(border, part[0]), place(border, part[1]), place(border, part[2])}, facet);
    }

    void cut_at(BinBorder border, const Corners3& part, const std::array<double, 3>& at,
                std::uint32_t facet) {
        const auto [low, high] = std::minmax({at[0], at[1], at[2]});
        const double level = std::round(0.5 * (low + high));
        const double first = std::floor(low + border_rounding) + 1.0;
        const bool whole = !(high > first + border_rounding);
        if (!(high > 0.0 && low < places(border))) return;
        if (whole || high - low > most_places) {
            if (border == BinBorder::range) return add(part, facet);
            cut_at(border == BinBorder::beam ? BinBorder::elevation : BinBorder::range, part,
                   facet);
            return;
        }
        const double cut =
            level > low + border_rounding && level < high - border_rounding ? level : first;
        // One corner is alone on its side.
        int alone = 0;
        for (int k = 0; k < 3; ++k) {
            const bool above = at[k] > cut;
            if (above != (at[(k + 1) % 3] > cut) && above != (at[(k + 2) % 3] > cut)) alone = k;
        }
        const int left = (alone + 1) % 3;
        const int right = (alone + 2) % 3;
        const Eigen::Vector3f to_left = crossing(border, cut, part[alone], part[left]);
        const Eigen::Vector3f to_right = crossing(border, cut, part[alone], part[right]);
        cut_at(border, {part[alone], to_left, to_right}, {at[alone], cut, cut}, facet);
        cut_at(border, {to_left, part[left], part[right]}, {cut, at[left], at[right]}, facet);
        cut_at(border, {to_left, part[right], to_right}, {cut, at[right], cut}, facet);
    }

    /// The point of a side at a border. The place is nearly linear along a side of a small part.
    Eigen::Vector3f crossing(BinBorder border, double level, const Eigen::Vector3f& a,
                             const Eigen::Vector3f& b) const {
        const double at_a = place(border, a) - level;
        const double at_b = place(border, b) - level;
        const double share = at_a / (at_a - at_b);
        const Eigen::Vector3f near = a + static_cast<float>(share) * (b - a);
        // One more step, from the nearer end of the side that still brackets the border.
        const double at = place(border, near) - level;
        const bool beyond = (at > 0.0) == (at_b > 0.0);
        const double way =
            beyond ? share * at_a / (at_a - at) : share + (1.0 - share) * at / (at - at_b);
        return a + static_cast<float>(way) * (b - a);
    }

    void add(const Corners3& part, std::uint32_t facet) {
        const Eigen::Vector3f middle = (part[0] + part[1] + part[2]) / 3.0F;
        const float area = 0.5F * (part[1] - part[0]).cross(part[2] - part[0]).norm();
        if (!(area > 0.0F)) return;
        const int bin = std::clamp(static_cast<int>(range_bin(middle)), 0, view_.range_bins - 1);
        const int beam = std::clamp(static_cast<int>(beam_at(middle)), 0, view_.beams - 1);
        pieces.push_back({part, area, facet});
        bin_of.push_back(static_cast<std::uint32_t>(beam * view_.range_bins + bin));
    }

    const View& view_;
    const ViewVolume volume_;
    const float bin_m_;
    const float range_min_m_;
    const float widest_rad_;
    std::vector<Corners3> left_;
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
