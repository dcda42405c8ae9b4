#include "visibility/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/elementary.h"
#include "visibility/angles.h"
#include "visibility/view_polygon.h"

namespace sonarsim {

namespace {

using Corners = TriangleRuns::Corners;

// The widest sector of azimuth in which a plane approximates a limit of elevation, which is a cone;
// the limits move by less than 2e-5 of the ground range.
constexpr double widest_sector_rad = 0.0125;

// The number of sides of the pyramid that replaces an echosounder's cone. Its sides touch the cone,
// and its edges lie 0.5 % further out.
constexpr int cone_planes = ViewPolygon::most_planes;

// A triangle is small if its corners give its interval of range to within this share of a bin.
constexpr float rounding_bins = 0.05F;

// Surface that reaches into a neighbouring bin by less than this does not cover that bin.
constexpr float least_overlap_bins = 1e-3F;

/// The bins of a view and which of them are covered.
class CoveredBins {
  public:
    explicit CoveredBins(const View& view)
        : min_m_(static_cast<float>(view.range_min_m)),
          per_m_(static_cast<float>(1.0 / view.bin_m())),
          count_(view.range_bins),
          covered_(static_cast<std::size_t>(view.beams) * view.range_bins) {}

    void mark(int beam, const RangeInterval& ranges) {
        const auto count = static_cast<float>(count_);
        const float from = (ranges.least - min_m_) * per_m_;
        const float to = (ranges.greatest - min_m_) * per_m_;
        if (!(from < count && to >= 0.0F)) return;
        int first = static_cast<int>(std::max(from, 0.0F));
        int last = static_cast<int>(std::min(to, count - 1.0F));
        if (first < last && static_cast<float>(first + 1) - from < least_overlap_bins) ++first;
        if (first < last && to - static_cast<float>(last) < least_overlap_bins) --last;
        std::uint8_t* own = &covered_[static_cast<std::size_t>(beam) * count_];
        for (int i = first; i <= last; ++i)
            own[i] = 1;
    }

    std::vector<std::uint8_t> take() { return std::move(covered_); }

  private:
    float min_m_, per_m_;
    int count_;
    std::vector<std::uint8_t> covered_;
};

Eigen::Vector3f normal_of(const Corners& corners) {
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// A fan, or the sides of a side-scan: sectors of azimuth, several to a beam.
class FanCoverage {
  public:
    explicit FanCoverage(const View& view)
        : per_beam_(static_cast<int>(std::ceil(view.azimuth_rad / view.beams / widest_sector_rad))),
          sectors_(per_beam_ * view.beams),
          per_rad_(static_cast<float>(sectors_ / view.azimuth_rad)),
          small2_m_(static_cast<float>(8.0 * rounding_bins * view.bin_m())),
          bins_(view) {
        const SinCosFloat elevation = sincos_float(0.5 * view.elevation_rad);
        elevation_ = elevation;
        for (int k = 0; k <= sectors_; ++k) {
            borders_.push_back(
                sincos_float((static_cast<double>(k) / sectors_ - 0.5) * view.azimuth_rad));
        }
        for (int k = 0; k < sectors_; ++k) {
            const SinCosFloat low = borders_[k];
            const SinCosFloat high = borders_[k + 1];
            const SinCosFloat middle =
                sincos_float(((k + 0.5) / sectors_ - 0.5) * view.azimuth_rad);
            const auto limit = [&](float side) {
                return Eigen::Vector3f(elevation.sin * middle.cos, elevation.sin * middle.sin,
                                       side * elevation.cos);
            };
            planes_.push_back({limit(1.0F), limit(-1.0F), Eigen::Vector3f(-low.sin, low.cos, 0.0F),
                               Eigen::Vector3f(high.sin, -high.cos, 0.0F)});
        }
    }

    void add(const Corners& corners) {
        const std::array<float, 3> range{corners[0].norm(), corners[1].norm(), corners[2].norm()};
        int above = 0;
        int below = 0;
        for (int k = 0; k < 3; ++k) {
            above += corners[k].z() > elevation_.sin * range[k] ? 1 : 0;
            below += corners[k].z() < -elevation_.sin * range[k] ? 1 : 0;
        }
        if (above == 3 || below == 3) return;  // the space above the view is convex
        std::array<float, 3> at;
        for (int k = 0; k < 3; ++k) {
            at[k] = arctan2_float(corners[k].y(), corners[k].x()) * per_rad_ +
                    0.5F * static_cast<float>(sectors_);
        }
        const float low = std::min({at[0], at[1], at[2]});
        const float high = std::max({at[0], at[1], at[2]});
        if ((high - low) > static_cast<float>(0.999 * pi) * per_rad_)
            return add_large(corners, at, 0, sectors_ - 1);  // behind the sonar or round its z axis
        if (!(low < static_cast<float>(sectors_) && high >= 0.0F)) return;
        const int first = static_cast<int>(std::max(low, 0.0F));
        const int last = std::min(static_cast<int>(high), sectors_ - 1);
        if (above + below == 0 && is_small(corners)) return add_small(at, range, first, last);
        add_large(corners, at, first, last);
    }

    std::vector<std::uint8_t> take() { return bins_.take(); }

  private:
    /// True if range and azimuth are linear over the triangle to within rounding_bins.
    bool is_small(const Corners& corners) const {
        const float longest2 = std::max({(corners[1] - corners[0]).squaredNorm(),
                                         (corners[2] - corners[1]).squaredNorm(),
                                         (corners[0] - corners[2]).squaredNorm()});
        const float ground2 =
            std::min({corners[0].head<2>().squaredNorm(), corners[1].head<2>().squaredNorm(),
                      corners[2].head<2>().squaredNorm()});
        return longest2 * longest2 < small2_m_ * small2_m_ * ground2;
    }

    /// Cuts a triangle in the plane of azimuth and range.
    void add_small(const std::array<float, 3>& at, const std::array<float, 3>& range, int first,
                   int last) {
        RangeInterval before = on_border(at, range, static_cast<float>(first));
        for (int sector = first; sector <= last; ++sector) {
            const auto border = static_cast<float>(sector);
            const RangeInterval behind = on_border(at, range, border + 1.0F);
            RangeInterval ranges{std::min(before.least, behind.least),
                                 std::max(before.greatest, behind.greatest)};
            for (int k = 0; k < 3; ++k) {
                if (at[k] >= border && at[k] < border + 1.0F) ranges.include(range[k]);
            }
            bins_.mark(sector / per_beam_, ranges);
            before = behind;
        }
    }

    static RangeInterval on_border(const std::array<float, 3>& at,
                                   const std::array<float, 3>& range, float border) {
        RangeInterval ranges;
        for (int k = 0; k < 3; ++k) {
            const int next = k < 2 ? k + 1 : 0;
            if ((at[k] < border) == (at[next] < border)) continue;
            const float along = (border - at[k]) / (at[next] - at[k]);
            ranges.include(range[k] + along * (range[next] - range[k]));
        }
        return ranges;
    }

    /// Adds a large triangle. In a sector that it crosses from border to border, its ranges lie
    /// between those at the two borders.
    void add_large(const Corners& corners, const std::array<float, 3>& at, int first, int last) {
        const Eigen::Vector3f normal = normal_of(corners);
        RangeInterval before = on_border(corners, borders_[first]);
        for (int sector = first; sector <= last; ++sector) {
            const RangeInterval behind = on_border(corners, borders_[sector + 1]);
            const auto border = static_cast<float>(sector);
            const bool corner_within =
                std::ranges::any_of(at, [&](float a) { return a >= border && a < border + 1.0F; });
            const bool ends = (before.least > before.greatest) != (behind.least > behind.greatest);
            bins_.mark(sector / per_beam_,
                       corner_within || ends
                           ? ranges_within(corners, normal, planes_[sector])
                           : RangeInterval{std::min(before.least, behind.least),
                                           std::max(before.greatest, behind.greatest)});
            before = behind;
        }
    }

    /// Ranges at which a triangle meets the half plane of an azimuth, within the limits of
    /// elevation.
    RangeInterval on_border(const Corners& corners, const SinCosFloat& azimuth) const {
        std::array<Eigen::Vector2f, 2> end;  // along the ground, up
        int ends = 0;
        for (int k = 0; k < 3 && ends < 2; ++k) {
            const Eigen::Vector3f& a = corners[k];
            const Eigen::Vector3f& b = corners[k < 2 ? k + 1 : 0];
            const float beside_a = azimuth.cos * a.y() - azimuth.sin * a.x();
            const float beside_b = azimuth.cos * b.y() - azimuth.sin * b.x();
            if ((beside_a < 0.0F) == (beside_b < 0.0F)) continue;
            const Eigen::Vector3f met = a + beside_a / (beside_a - beside_b) * (b - a);
            end[ends++] = {azimuth.cos * met.x() + azimuth.sin * met.y(), met.z()};
        }
        if (ends < 2) return {};
        for (const float side : {1.0F, -1.0F}) {
            const Eigen::Vector2f inwards(elevation_.sin, side * elevation_.cos);
            const float a = inwards.dot(end[0]);
            const float b = inwards.dot(end[1]);
            if (a < 0.0F && b < 0.0F) return {};
            if ((a < 0.0F) != (b < 0.0F))
                end[a < 0.0F ? 0 : 1] = (end[0] + a / (a - b) * (end[1] - end[0])).eval();
        }
        RangeInterval ranges;
        ranges.include(end[0].norm());
        ranges.include(end[1].norm());
        const Eigen::Vector2f edge = end[1] - end[0];
        const float along = -end[0].dot(edge);
        const float length2 = edge.squaredNorm();
        if (along > 0.0F && along < length2)
            ranges.include((end[0] + along / length2 * edge).norm());
        return ranges;
    }

    int per_beam_;
    int sectors_;
    float per_rad_;
    float small2_m_;         ///< limit of (longest edge)^2 / ground range of a small triangle
    SinCosFloat elevation_;  ///< greatest elevation of the view
    std::vector<SinCosFloat> borders_;                    ///< azimuths of the sectors' borders
    std::vector<std::array<Eigen::Vector3f, 4>> planes_;  ///< the planes of each sector
    CoveredBins bins_;
};

/// A cone: one beam, cut by the planes of a pyramid.
class ConeCoverage {
  public:
    explicit ConeCoverage(const View& view) : bins_(view) {
        const SinCosFloat half = sincos_float(0.5 * view.azimuth_rad);
        for (int k = 0; k < cone_planes; ++k) {
            const SinCosFloat around = sincos_float((k + 0.5) / cone_planes * 2.0 * pi);
            planes_[k] = {half.sin, -half.cos * around.cos, -half.cos * around.sin};
        }
    }

    void add(const Corners& corners) {
        for (const Eigen::Vector3f& inwards : planes_) {
            if (inwards.dot(corners[0]) < 0.0F && inwards.dot(corners[1]) < 0.0F &&
                inwards.dot(corners[2]) < 0.0F)
                return;
        }
        bins_.mark(0, ranges_within(corners, normal_of(corners), planes_));
    }

    std::vector<std::uint8_t> take() { return bins_.take(); }

  private:
    std::array<Eigen::Vector3f, cone_planes> planes_;
    CoveredBins bins_;
};

template <class Coverage>
std::vector<std::uint8_t> covered_by(const TriangleRuns& surface, const View& view,
                                     const Pose& T_world_sensor,
                                     std::span<const Pose> T_world_body) {
    Coverage coverage(view);
    surface.visit(view, T_world_sensor, T_world_body,
                  [&](const Corners& corners) { coverage.add(corners); });
    return coverage.take();
}

}  // namespace

std::vector<std::uint8_t> covered_bins(const TriangleRuns& surface, const View& view,
                                       const Pose& T_world_sensor,
                                       std::span<const Pose> T_world_body) {
    const bool cone = view.shape == ViewShape::cone;
    return (cone ? covered_by<ConeCoverage>
                 : covered_by<FanCoverage>)(surface, view, T_world_sensor, T_world_body);
}

}  // namespace sonarsim
