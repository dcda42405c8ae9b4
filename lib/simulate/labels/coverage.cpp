#include "simulate/labels/coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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
RangeInterval ranges_within(const Corners& triangle, ConvexView view) {
    ViewPolygon polygons[2];
    std::copy(triangle.begin(), triangle.end(), polygons[0].corner.begin());
    polygons[0].corners = 3;
    int now = 0;
    for (const Eigen::Vector3f& inwards : view) {
        cut(polygons[now], inwards, polygons[1 - now]);
        now = 1 - now;
        if (polygons[now].corners == 0) return {};
    }
    return ranges_of(polygons[now], (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]));
}

// The widest sector of azimuth in which a plane stands for the cone of an elevation (to 2e-5).
constexpr double widest_sector_rad = 0.0125;

// The sides of the pyramid around an echosounder's cone. Its edges lie 0.5 % further out.
constexpr int cone_planes = ViewPolygon::max_planes;

// Surface that reaches into a neighbouring bin by less than this does not cover that bin.
constexpr float min_overlap_bins = 1e-3F;

/// The bins of a view and which of them are covered.
class Coverage {
  public:
    explicit Coverage(const View& view)
        : view_(view),
          per_m_(static_cast<float>(1.0 / view.bin_m())),
          elevation_(sincos_float(0.5 * view.elevation_rad)),
          covered_(static_cast<std::size_t>(view.beams) * view.range_bins) {
        if (view.shape == ViewShape::cone)
            add_pyramid();
        else
            add_sectors();
    }

    void add(const Corners& corners) {
        if (view_.shape == ViewShape::cone)
            add_to_cone(corners);
        else
            add_to_fan(corners);
    }

    std::vector<std::uint8_t> take() { return std::move(covered_); }

  private:
    /// The planes of a cone: one beam.
    void add_pyramid() {
        const SinCosFloat half = sincos_float(0.5 * view_.azimuth_rad);
        for (int k = 0; k < cone_planes; ++k) {
            const SinCosFloat around = sincos_float((k + 0.5) / cone_planes * 2.0 * pi);
            planes_.emplace_back(half.sin, -half.cos * around.cos, -half.cos * around.sin);
        }
    }

    /// The planes of a fan, or of the sides of a side-scan: sectors of azimuth, several to a beam.
    void add_sectors() {
        per_beam_ =
            static_cast<int>(std::ceil(view_.azimuth_rad / view_.beams / widest_sector_rad));
        sectors_ = per_beam_ * view_.beams;
        const auto azimuth = [&](double sector) {
            return sincos_float((sector / sectors_ - 0.5) * view_.azimuth_rad);
        };
        for (int k = 0; k < sectors_; ++k) {
            const SinCosFloat low = azimuth(k);
            const SinCosFloat high = azimuth(k + 1.0);
            const SinCosFloat middle = azimuth(k + 0.5);
            planes_.emplace_back(-low.sin, low.cos, 0.0F);
            planes_.emplace_back(high.sin, -high.cos, 0.0F);
            for (const float side : {1.0F, -1.0F})
                planes_.emplace_back(elevation_.sin * middle.cos, elevation_.sin * middle.sin,
                                     side * elevation_.cos);
        }
    }

    void add_to_cone(const Corners& corners) {
        for (const Eigen::Vector3f& inwards : planes_) {
            if (inwards.dot(corners[0]) < 0.0F && inwards.dot(corners[1]) < 0.0F &&
                inwards.dot(corners[2]) < 0.0F)
                return;
        }
        mark(0, ranges_within(corners, planes_));
    }

    void add_to_fan(const Corners& corners) {
        const auto sectors = static_cast<float>(sectors_);
        const auto per_rad = static_cast<float>(sectors_ / view_.azimuth_rad);
        int above = 0;
        int below = 0;
        std::array<float, 3> at;
        for (int k = 0; k < 3; ++k) {
            const float highest = elevation_.sin * corners[k].norm();
            above += corners[k].z() > highest ? 1 : 0;
            below += corners[k].z() < -highest ? 1 : 0;
            at[k] = arctan2_float(corners[k].y(), corners[k].x()) * per_rad + 0.5F * sectors;
        }
        if (above == 3 || below == 3) return;  // the space above the view is convex
        auto [low, high] = std::ranges::minmax(at);
        if ((high - low) > static_cast<float>(0.999 * pi) * per_rad) {
            low = 0.0F;  // behind the sonar or round its z axis
            high = sectors;
        }
        if (!(low < sectors && high >= 0.0F)) return;
        const int last = std::min(static_cast<int>(high), sectors_ - 1);
        for (int sector = static_cast<int>(std::max(low, 0.0F)); sector <= last; ++sector) {
            const auto planes = std::span(planes_).subspan(std::size_t{4} * sector, 4);
            mark(sector / per_beam_, ranges_within(corners, planes));
        }
    }

    void mark(int beam, const RangeInterval& ranges) {
        const auto count = static_cast<float>(view_.range_bins);
        const auto min_m = static_cast<float>(view_.range_min_m);
        const float from = (ranges.min_m - min_m) * per_m_;
        const float to = (ranges.max_m - min_m) * per_m_;
        if (!(from < count && to >= 0.0F)) return;
        int first = static_cast<int>(std::max(from, 0.0F));
        int last = static_cast<int>(std::min(to, count - 1.0F));
        if (first < last && static_cast<float>(first + 1) - from < min_overlap_bins) ++first;
        if (first < last && to - static_cast<float>(last) < min_overlap_bins) --last;
        std::uint8_t* own = &covered_[static_cast<std::size_t>(beam) * view_.range_bins];
        std::fill(own + first, own + last + 1, std::uint8_t{1});
    }

    const View& view_;
    float per_m_;
    SinCosFloat elevation_;                ///< greatest elevation of the view
    std::vector<Eigen::Vector3f> planes_;  ///< four for each sector, or the cone's
    int per_beam_ = 0, sectors_ = 0;
    std::vector<std::uint8_t> covered_;
};

}  // namespace

std::vector<std::uint8_t> covered_bins(const SceneClusters& surface, const View& view,
                                       const Pose& T_world_sensor,
                                       std::span<const Pose> T_world_body) {
    Coverage coverage(view);
    surface.in_view(view, T_world_sensor, T_world_body)
        .visit_triangles([&](const Corners& corners) { coverage.add(corners); });
    return coverage.take();
}

}  // namespace sonarsim
