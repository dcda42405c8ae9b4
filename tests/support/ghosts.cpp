#include "support/ghosts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "paper/paper_model.h"
#include "support/draws.h"
#include "trace/multipath.h"
#include "trace/traced_ping.h"
#include "validation/image_error.h"
#include "support/shapes.h"
#include "visibility/angles.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim::test {

namespace {

using Eigen::Vector3f;

/// Adds a body about the origin, turned at random, at `centre`.
void add_body(Draws& draws, Ghost& ghost, const Vector3f& centre, float size,
              std::uint32_t material) {
    Scene& scene = ghost.scene;
    const std::size_t first = scene.vertices.size();
    if (ghost.shape == "ball" || ghost.shape == "balls") {
        shapes::add_sphere(scene, Vector3f::Zero(), size, material, 2 * draws.whole(6, 28));
    } else if (ghost.shape == "box") {
        const float x = draws.between(0.2F, 1.0F);
        const float y = draws.between(0.2F, 1.0F);
        const Vector3f half(x * size, y * size, size);
        shapes::add_box(scene, -half, half, material);
    } else {
        const float radius = draws.between(0.2F, 0.7F) * size;
        shapes::add_pole(scene, {0, 0, -size}, radius, 2.0F * size, material, draws.whole(6, 40));
    }
    const Vector3f axis = draws.in_ball().normalized();
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(draws.between(0.0F, 3.1F), axis).toRotationMatrix();
    for (std::size_t k = first; k < scene.vertices.size(); ++k)
        scene.vertices[k] = turn * scene.vertices[k] + centre;
}

/// A wall behind the body that leans and is turned.
void add_wall(Draws& draws, Scene& scene, float x, std::uint32_t material) {
    constexpr float half = 12.0F;
    const float lean = draws.between(-0.4F, 0.4F);
    const float turn = draws.between(-0.6F, 0.6F);
    const auto corner = [&](float y, float z) -> Vector3f {
        return {x + turn * y + lean * z, y, z};
    };
    shapes::add_quad(scene, corner(-half, -half), corner(half, -half), corner(half, half),
                     corner(-half, half), material);
}

/// The point of the surface in a random direction of the view, as a patch without extent.
Samples random_points(const VisibilityEngine& engine, const View& view, const Pose& pose,
                      std::uint32_t first, std::uint32_t count) {
    std::vector<Ray> rays;
    rays.reserve(count);
    const auto top = static_cast<float>(std::sin(0.5 * view.elevation_rad));
    for (std::uint32_t k = first; k < first + count; ++k) {
        const PhiloxBlock draw = philox({k, 0, 0, 0}, {0x67686F73U, 1});
        const double azimuth = (static_cast<double>(unit_float(draw.x0)) - 0.5) * view.azimuth_rad;
        // Evenly in the sine, so evenly in solid angle.
        const double elevation =
            std::asin(static_cast<double>((2.0F * unit_float(draw.x1) - 1.0F) * top));
        rays.push_back({Vector3f::Zero(), direction_of(azimuth, elevation).cast<float>()});
    }
    std::vector<Intersection> hits(rays.size());
    engine.intersect(pose, rays, hits);
    Samples out;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const Intersection& hit = hits[k];
        const float cosine = -hit.normal.dot(rays[k].direction);
        if (!std::isfinite(hit.distance_m) || !(cosine > 1e-3F)) continue;
        Sample sample{};
        sample.position = hit.distance_m * rays[k].direction;
        sample.edge_u = sample.edge_v = Vector3f::Zero();
        sample.normal = hit.normal;
        sample.height_m = cosine * hit.distance_m;
        sample.area_m2 = hit.distance_m * hit.distance_m / cosine;
        sample.material = hit.material;
        out.items.push_back(sample);
    }
    return out;
}

}  // namespace

Ghost draw_ghost(std::uint32_t number) {
    Draws draws(number);
    constexpr std::array shapes{"ball", "box", "cylinder", "balls"};
    Ghost ghost;
    ghost.shape = shapes[number % shapes.size()];
    ghost.scene = shapes::empty_scene();
    Scene& scene = ghost.scene;
    scene.instances.emplace_back("ghost");
    const std::uint32_t material = shapes::add_material(scene, 0.7F);
    const float distance = draws.between(2.5F, 5.0F);
    const bool under_water = number / shapes.size() % 3 == 2;
    const int bodies = ghost.shape == "balls" ? draws.whole(2, 4) : 1;
    for (int k = 0; k < bodies; ++k) {
        const float size = draws.between(0.3F, bodies > 1 ? 0.5F : 1.0F);
        const float y = draws.between(-1.2F, 1.2F);
        const float z = draws.between(-0.4F, 0.4F);
        add_body(draws, ghost, {distance, y, z}, size, material);
    }
    if (under_water)
        scene.water_surface = WaterSurface{draws.between(1.0F, 2.5F), 0.9F};
    else
        add_wall(draws, scene, distance + draws.between(1.5F, 3.5F), material);
    const double roll = draws.between(-0.2F, 0.2F);
    const double pitch = draws.between(-0.15F, 0.15F);
    const double yaw = draws.between(-0.2F, 0.2F);
    ghost.T_world_sensor = Pose{rotation_from_rpy(roll, pitch, yaw), Eigen::Vector3d::Zero()};
    return ghost;
}

std::vector<float> ghost_reference(const Ghost& ghost, const View& view, std::uint32_t rays) {
    constexpr std::uint32_t batch = 100'000;
    Multipath exact;
    exact.on = true;
    const auto engine = make_rays_engine(ghost.scene);
    const TraceContext context{.view = view,
                               .scene = ghost.scene,
                               .engine = *engine,
                               .T_world_sensor = ghost.T_world_sensor};
    const std::size_t bins =
        static_cast<std::size_t>(view.range_bins) * static_cast<std::size_t>(view.beams);
    std::vector<double> weights(bins);
    std::vector<double> echoes(bins);
    for (std::uint32_t first = 0; first < rays; first += batch) {
        const Samples points = random_points(*engine, view, ghost.T_world_sensor, first, batch);
        MultipathCounts counts;
        for (const BouncePath& b : find_bounces(exact, context, points, counts)) {
            const int bin = static_cast<int>(
                std::floor((b.range_m - static_cast<float>(view.range_min_m)) / view.bin_m()));
            if (bin < 0 || bin >= view.range_bins) continue;
            const std::size_t k =
                static_cast<std::size_t>(bin) * static_cast<std::size_t>(view.beams) +
                static_cast<std::size_t>(b.beam);
            const auto weight = static_cast<double>(points.items[b.sample].area_m2);
            weights[k] += weight;
            echoes[k] += weight * static_cast<double>(b.intensity);
        }
    }
    std::vector<float> image(bins);
    for (std::size_t k = 0; k < bins; ++k)
        if (weights[k] > 0.0) image[k] = static_cast<float>(echoes[k] / weights[k]);
    return image;
}

int occupied_bins(const std::vector<float>& image) {
    return static_cast<int>(std::ranges::count_if(image, [](float x) { return x > 0.0F; }));
}

GhostError ghost_error(const Ghost& ghost, const View& view, int columns_per_beam,
                       const std::vector<float>& reference) {
    const auto engine = make_rays_engine(ghost.scene);
    TraceSettings settings;
    settings.view = view;
    settings.guard_beams.divided = columns_per_beam;
    settings.multipath.on = true;
    const TracedPing traced = trace_ping(settings, ghost.scene, *engine, ghost.T_world_sensor);
    Ping ping;
    ping.range_bins = view.range_bins;
    ping.beams = view.beams;
    ping.intensity.resize(reference.size());
    PaperModel{}.form(
        traced, {.view = view, .scene = ghost.scene, .draws = {}, .terms = multipath_alone}, ping);
    const ImageError error = image_error(ping.intensity, reference);
    return {error.miss_rate, image_error(reference, ping.intensity).miss_rate, error.relative_l1, traced.missed_multipath};
}

}  // namespace sonarsim::test
