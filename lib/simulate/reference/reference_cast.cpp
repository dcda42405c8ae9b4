#include "simulate/reference/reference_cast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/random.h"

namespace sonarsim {

namespace {

// Number of rays to points of the surface per ray over directions.
constexpr double points_per_ray = 0.5;

/// dOmega / (d across d along) at a direction of the sensor frame.
double solid_angle_density(ViewShape shape, const Eigen::Vector3f& d) {
    const float x = shape == ViewShape::cone ? d.z() : d.x();
    return std::sqrt(static_cast<double>(x) * x + static_cast<double>(d.y()) * d.y());
}

/// Number of points per square metre on each facet.
class PointDensity {
  public:
    PointDensity(const ReferenceView& looking, std::span<const std::uint32_t> counts)
        : shares_(looking.shares),
          counts_(counts),
          own_density_(looking.scene.triangles.size(), 0.0F) {
        while (own_shares_ < shares_.size() && shares_[own_shares_].copy == SurfaceShare::no_copy) {
            own_density_[shares_[own_shares_].facet] = per_m2(own_shares_);
            ++own_shares_;
        }
    }

    float of(std::uint32_t facet) const {
        if (facet < own_density_.size()) return own_density_[facet];
        // Looked up: copies may have more triangles than memory holds, few of them in view.
        const auto copy_shares = shares_.subspan(own_shares_);
        const auto at = std::ranges::lower_bound(copy_shares, facet, {}, &SurfaceShare::facet);
        if (at == copy_shares.end() || at->facet != facet) return 0.0F;
        return per_m2(own_shares_ + static_cast<std::size_t>(at - copy_shares.begin()));
    }

  private:
    float per_m2(std::size_t share) const {
        return static_cast<float>(counts_[share]) / shares_[share].area_m2;
    }

    std::span<const SurfaceShare> shares_;
    std::span<const std::uint32_t> counts_;  ///< number of points by share
    std::vector<float> own_density_;
    /// Number of shares of the scene's own triangles, which come first.
    std::size_t own_shares_ = 0;
};

/// Sound from below the water's surface does not arrive above it. Scene-local, m.
double highest_received(const ReferenceView& looking) {
    const auto& surface = looking.scene.water_surface;
    if (!surface || looking.T_world_sensor.translation.z() > surface->height_m)
        return std::numeric_limits<double>::infinity();
    return surface->height_m + WaterSurface::slack_m - looking.scene.origin.z();
}

struct Cast {
    const ReferenceView& looking;
    const RayLayout& layout;
    const PointDensity& points;
    double cell_rad2;  ///< cell of a ray: step across times step along
    const PointSink& found;
    double top_m = highest_received(looking);  ///< height of the water's surface, scene-local
    std::uint64_t rays = 0;

    /// Reports the point that a ray has met. `density`: solid_angle_density() of its direction.
    void add(const Eigen::Vector3f& direction, double density, int beam, std::uint32_t index) {
        const Facet facet = looking.caster.facet(index);
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        const double facing = normal.dot(direction.cast<double>());
        const double range =
            normal.dot((facet.vertex - looking.pose.position).cast<double>()) / facing;
        if (looking.pose.position.z() + range * direction.z() > top_m) return;
        const double cosine = std::fabs(facing);
        const double rays_per_m2 = cosine / (range * range * density * cell_rad2);
        found({direction, range, cosine, 1.0 / (rays_per_m2 + points.of(index)), beam, facet});
    }

    float reach_m() const { return static_cast<float>(looking.view.range_max_m) * 1.01F; }
};

/// Position of ray i in its cell: shares of the column's width and of a step along it. A lattice
/// oblique to both, so that an edge along either is sampled at all phases; one per cast and beam.
struct CellPosition {
    double across;
    double along;
};

CellPosition position_in_cell(const PhiloxBlock& shift, std::uint32_t column, std::uint32_t i) {
    constexpr double golden = 0.6180339887498949;
    constexpr double root_two = 0.4142135623730950;
    const double across = unit_float(shift.x0) + golden * i;
    const double along = unit_float(shift.x1) + root_two * column;
    return {across - std::floor(across), along - std::floor(along)};
}

void column_directions(const Cast& cast, const ViewColumn& column, std::uint32_t index,
                       std::vector<Eigen::Vector3f>& directions) {
    const double step = (column.along_max - column.along_min) / cast.layout.count;
    const SinCosFloat middle = sincos_float(column.across);
    const auto beam = static_cast<std::uint32_t>(column.beam);
    const PhiloxBlock shift = philox({beam, cast.layout.start, 0, 0}, {0x72617973U, 0});
    for (std::uint32_t i = 0; i < directions.size(); ++i) {
        const CellPosition position = position_in_cell(shift, index, i);
        const auto off = static_cast<float>((position.across - 0.5) * column.width);
        const SinCosFloat along = sincos_float(column.along_min + (i + position.along) * step);
        directions[i] = direction(cast.looking.view.shape, middle + sincos_small(off), along);
    }
}

void cast_directions(Cast& cast) {
    const ReferenceView& looking = cast.looking;
    std::vector<Eigen::Vector3f> in_sensor(cast.layout.count);
    std::vector<Eigen::Vector3f> directions(cast.layout.count);
    std::vector<std::uint32_t> met(cast.layout.count);
    std::uint32_t index = 0;
    for (const ViewColumn& column : view_columns(looking.view, cast.layout.per_beam)) {
        cast.cell_rad2 = column.width * (column.along_max - column.along_min) / cast.layout.count;
        column_directions(cast, column, index++, in_sensor);
        std::ranges::transform(in_sensor, directions.begin(), [&](const Eigen::Vector3f& d) {
            return Eigen::Vector3f(looking.pose.rotation * d);
        });
        looking.caster.cast(looking.pose.position, directions, cast.reach_m(), met);
        for (std::size_t i = 0; i < met.size(); ++i) {
            if (met[i] == Caster::nothing) continue;
            const double density = solid_angle_density(looking.view.shape, in_sensor[i]);
            cast.add(directions[i], density, column.beam, met[i]);
        }
        cast.rays += met.size();
    }
}

/// Rays to points of the surface, collected for one cast.
struct PointRays {
    std::vector<Eigen::Vector3f> directions = {};  ///< scene-local frame
    std::vector<double> densities = {};
    std::vector<int> beams = {};
    std::vector<std::uint32_t> facets = {};
    std::vector<std::uint32_t> met = {};
};

/// Casts the collected rays. A point is visible if the ray to it meets its own triangle.
void cast_points(Cast& cast, PointRays& rays) {
    rays.met.resize(rays.directions.size());
    cast.looking.caster.cast(cast.looking.pose.position, rays.directions, cast.reach_m(), rays.met);
    for (std::size_t i = 0; i < rays.met.size(); ++i) {
        if (rays.met[i] != rays.facets[i]) continue;
        cast.add(rays.directions[i], rays.densities[i], rays.beams[i], rays.met[i]);
    }
    cast.rays += rays.met.size();
    rays = {};
}

void collect_points(const Cast& cast, const SurfaceShare& share, std::uint32_t count,
                    PointRays& rays) {
    const ReferenceView& looking = cast.looking;
    const std::array<Eigen::Vector3f, 3> corners = corners_of(looking.scene, share);
    const Eigen::Vector3d a = corners[0].cast<double>();
    const Eigen::Vector3d ab = corners[1].cast<double>() - a;
    const Eigen::Vector3d ac = corners[2].cast<double>() - a;
    const Eigen::Vector3d from_sonar = a - looking.pose.position.cast<double>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const Eigen::Vector2d at = point_of_triangle(share.facet, i, cast.layout.start);
        const Eigen::Vector3d point = from_sonar + at.x() * ab + at.y() * ac;
        const Eigen::Vector3f direction = point.normalized().cast<float>();
        const Eigen::Vector3f in_sensor = looking.pose.rotation.transpose() * direction;
        const int beam = beam_of(looking.view, in_sensor);
        if (beam < 0) continue;
        rays.directions.push_back(direction);
        rays.densities.push_back(solid_angle_density(looking.view.shape, in_sensor));
        rays.beams.push_back(beam);
        rays.facets.push_back(share.facet);
    }
}

std::vector<std::uint32_t> counts_of(std::span<const SurfaceShare> shares, double points) {
    double sum = 0.0;
    for (const SurfaceShare& share : shares)
        sum += share.share;
    std::vector<std::uint32_t> counts;
    counts.reserve(shares.size());
    for (const SurfaceShare& share : shares)
        counts.push_back(static_cast<std::uint32_t>(std::ceil(points * share.share / sum)));
    return counts;
}

}  // namespace

MappedPoint surface_at(const SurfacePoint& point, const Scene& scene, const LocalPose& pose) {
    const Facet& facet = point.facet;
    if (!scene.maps || !scene.maps->lie_on(facet.instance)) return {facet.material, 1.0F};
    const Eigen::Vector3d local =
        pose.position.cast<double>() + point.range_m * point.direction.cast<double>();
    return scene.maps->at(facet.instance, facet.material, (scene.origin + local).head<2>());
}

std::uint64_t cast_over_surface(const ReferenceView& looking, const RayLayout& layout,
                                const PointSink& found) {
    constexpr std::size_t together = 4096;
    const std::size_t rays = view_columns(looking.view, layout.per_beam).size() * layout.count;
    const std::vector<std::uint32_t> counts =
        counts_of(looking.shares, points_per_ray * static_cast<double>(rays));
    const PointDensity density(looking, counts);
    Cast cast{looking, layout, density, 0.0, found};
    cast_directions(cast);
    PointRays points;
    for (std::size_t s = 0; s < counts.size(); ++s) {
        collect_points(cast, looking.shares[s], counts[s], points);
        if (points.directions.size() >= together) cast_points(cast, points);
    }
    cast_points(cast, points);
    return cast.rays;
}

}  // namespace sonarsim
