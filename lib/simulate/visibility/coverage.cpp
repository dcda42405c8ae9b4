#include "simulate/visibility/coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

namespace {

using Corners = std::array<Eigen::Vector3f, 3>;

/// A convex part of the view: planes through the sonar, given by normals that point inwards.
using ConvexView = std::span<const Eigen::Vector3f>;

/// A triangle of the sensor frame that up to `max_planes` planes have cut.
struct ViewPolygon {
    static constexpr int max_planes = 32;

    std::array<Eigen::Vector3f, 3 + max_planes> corner;
    int corners = 0;
};

/// Least and greatest distance from the sonar, m; least > greatest if it is empty.
struct RangeInterval {
    float min_m = std::numeric_limits<float>::infinity();
    float max_m = -std::numeric_limits<float>::infinity();

    void include(float range_m) {
        min_m = std::min(min_m, range_m);
        max_m = std::max(max_m, range_m);
    }
};

/// Keeps the part of a polygon on the inner side of a plane through the sonar.
void cut(const ViewPolygon& from, const Eigen::Vector3f& inwards, ViewPolygon& to) {
    to.corners = 0;
    const Eigen::Vector3f* a = &from.corner[from.corners - 1];
    float height_a = inwards.dot(*a);
    for (int i = 0; i < from.corners; ++i) {
        const Eigen::Vector3f* b = &from.corner[i];
        const float height_b = inwards.dot(*b);
        if ((height_a >= 0.0F) != (height_b >= 0.0F))
            to.corner[to.corners++] = *a + height_a / (height_a - height_b) * (*b - *a);
        if (height_b >= 0.0F) to.corner[to.corners++] = *b;
        a = b;
        height_a = height_b;
    }
}

/// The interval of distances of a convex, planar polygon.
RangeInterval ranges_of(const ViewPolygon& polygon, const Eigen::Vector3f& normal) {
    RangeInterval ranges;
    const float square = normal.squaredNorm();
    const Eigen::Vector3f foot =
        square > 0.0F ? Eigen::Vector3f(normal * (normal.dot(polygon.corner[0]) / square))
                      : Eigen::Vector3f::Zero();
    bool left = square > 0.0F;  // the foot of the sonar's perpendicular is to the left of all edges
    bool right = left;
    const Eigen::Vector3f* a = &polygon.corner[polygon.corners - 1];
    for (int i = 0; i < polygon.corners; ++i) {
        const Eigen::Vector3f* b = &polygon.corner[i];
        const Eigen::Vector3f edge = *b - *a;
        const float length2 = edge.squaredNorm();
        ranges.include(b->norm());
        const float along = -a->dot(edge);
        if (along > 0.0F && along < length2) ranges.include((*a + along / length2 * edge).norm());
        const float side = normal.dot(edge.cross(foot - *a));
        left = left && side >= 0.0F;
        right = right && side <= 0.0F;
        a = b;
    }
    if (left != right) ranges.include(foot.norm());
    return ranges;
}

/// The interval of distances of the part of a triangle inside a convex view.
RangeInterval ranges_within(const std::array<Eigen::Vector3f, 3>& triangle,
                            const Eigen::Vector3f& normal, ConvexView view) {
    ViewPolygon polygons[2];
    std::copy(triangle.begin(), triangle.end(), polygons[0].corner.begin());
    polygons[0].corners = 3;
    int now = 0;
    for (const Eigen::Vector3f& inwards : view) {
        cut(polygons[now], inwards, polygons[1 - now]);
        now = 1 - now;
        if (polygons[now].corners == 0) return {};
    }
    return ranges_of(polygons[now], normal);
}

// The widest sector of azimuth in which a plane approximates a limit of elevation, which is a cone;
// the limits move by less than 2e-5 of the ground range.
constexpr double widest_sector_rad = 0.0125;

// The number of sides of the pyramid that replaces an echosounder's cone. Its sides touch the cone,
// and its edges lie 0.5 % further out.
constexpr int cone_planes = ViewPolygon::max_planes;

// Surface that reaches into a neighbouring bin by less than this does not cover that bin.
constexpr float min_overlap_bins = 1e-3F;

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
        const float from = (ranges.min_m - min_m_) * per_m_;
        const float to = (ranges.max_m - min_m_) * per_m_;
        if (!(from < count && to >= 0.0F)) return;
        int first = static_cast<int>(std::max(from, 0.0F));
        int last = static_cast<int>(std::min(to, count - 1.0F));
        if (first < last && static_cast<float>(first + 1) - from < min_overlap_bins) ++first;
        if (first < last && to - static_cast<float>(last) < min_overlap_bins) --last;
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
          elevation_(sincos_float(0.5 * view.elevation_rad)),
          bins_(view) {
        const auto azimuth = [&](double sector) {
            return sincos_float((sector / sectors_ - 0.5) * view.azimuth_rad);
        };
        for (int k = 0; k < sectors_; ++k) {
            const SinCosFloat low = azimuth(k);
            const SinCosFloat high = azimuth(k + 1.0);
            const SinCosFloat middle = azimuth(k + 0.5);
            const auto limit = [&](float side) {
                return Eigen::Vector3f(elevation_.sin * middle.cos, elevation_.sin * middle.sin,
                                       side * elevation_.cos);
            };
            planes_.push_back({Eigen::Vector3f(-low.sin, low.cos, 0.0F),
                               Eigen::Vector3f(high.sin, -high.cos, 0.0F), limit(1.0F),
                               limit(-1.0F)});
        }
    }

    void add(const Corners& corners) {
        int above = 0;
        int below = 0;
        std::array<float, 3> at;
        for (int k = 0; k < 3; ++k) {
            const float highest = elevation_.sin * corners[k].norm();
            above += corners[k].z() > highest ? 1 : 0;
            below += corners[k].z() < -highest ? 1 : 0;
            at[k] = arctan2_float(corners[k].y(), corners[k].x()) * per_rad_ +
                    0.5F * static_cast<float>(sectors_);
        }
        if (above == 3 || below == 3) return;  // the space above the view is convex
        float low = std::min({at[0], at[1], at[2]});
        float high = std::max({at[0], at[1], at[2]});
        if ((high - low) > static_cast<float>(0.999 * pi) * per_rad_) {
            low = 0.0F;  // behind the sonar or round its z axis
            high = static_cast<float>(sectors_);
        }
        if (!(low < static_cast<float>(sectors_) && high >= 0.0F)) return;
        const int first = static_cast<int>(std::max(low, 0.0F));
        const int last = std::min(static_cast<int>(high), sectors_ - 1);
        const Eigen::Vector3f normal = normal_of(corners);
        for (int sector = first; sector <= last; ++sector)
            bins_.mark(sector / per_beam_, ranges_within(corners, normal, planes_[sector]));
    }

    std::vector<std::uint8_t> take() { return bins_.take(); }

  private:
    int per_beam_;
    int sectors_;
    float per_rad_;
    SinCosFloat elevation_;                               ///< greatest elevation of the view
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
std::vector<std::uint8_t> covered_by(const SceneClusters& surface, const View& view,
                                     const Pose& T_world_sensor,
                                     std::span<const Pose> T_world_body) {
    Coverage coverage(view);
    surface.in_view(view, T_world_sensor, T_world_body)
        .visit_triangles([&](const Corners& corners) { coverage.add(corners); });
    return coverage.take();
}

}  // namespace

std::vector<std::uint8_t> covered_bins(const SceneClusters& surface, const View& view,
                                       const Pose& T_world_sensor,
                                       std::span<const Pose> T_world_body) {
    const bool cone = view.shape == ViewShape::cone;
    return (cone ? covered_by<ConeCoverage>
                 : covered_by<FanCoverage>)(surface, view, T_world_sensor, T_world_body);
}

}  // namespace sonarsim
