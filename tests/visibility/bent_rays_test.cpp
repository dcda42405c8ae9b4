#include "simulate/visibility/rays/bent_rays.h"

#include "simulate/water/water_ray.h"
#include "support/patches.h"

namespace {

// Strong, so that the bending is large: arcs of 5 km.
constexpr double bent_gradient = 0.3;
constexpr double bent_bottom_m = -40.0;

/// A flat bottom under water of one gradient, 1500 m/s at z = 0.
Scene floor_under(double gradient) {
    Scene scene = floor_scene(400.0F, static_cast<float>(bent_bottom_m), 0.5F, 16);
    scene.sound_profile = std::make_shared<const SoundProfile>(SoundProfile{
        {-100.0, 100.0}, {1500.0 - 100.0 * gradient, 1500.0 + 100.0 * gradient}, 1480.0});
    return scene;
}

/// A ray in the constant gradient, at the elevation a, that reaches the bottom.
struct Arc {
    double a, b;

    explicit Arc(double elevation)
        : a(elevation),
          b(-std::acos(std::cos(a) * (1.0 + bent_gradient * bent_bottom_m / 1500.0))) {}

    double time_s() const {
        return (std::atanh(std::sin(a)) - std::atanh(std::sin(b))) / bent_gradient;
    }
    double distance_m() const {
        return 1500.0 / (bent_gradient * std::cos(a)) * (std::sin(a) - std::sin(b));
    }
    /// The derivative of the distance by the elevation.
    double slope() const {
        return (Arc(a + 1e-5).distance_m() - Arc(a - 1e-5).distance_m()) / 2e-5;
    }
};

/// A fan of 60 x 30 degrees that looks ahead and 25 degrees down, at z = 0.
const View bent_view{radians(60.0), radians(30.0), 1.0, 300.0, 1500, 60, 0.02};
const Pose bent_pose = pitched(25.0);

}  // namespace

TEST_CASE("bent rays: range, angle and area of a flat bottom in a constant gradient") {
    // The apparent range is 1480 m/s times the time; the true incidence has the cosine -sin b.
    const Scene scene = floor_under(bent_gradient);
    const Samples samples =
        engine_of(scene, EngineKind::rays)->visible_surface(bent_view, bent_pose);
    REQUIRE(samples.items.size() > 1000);
    for (const Sample& sample : samples.items) {
        const Eigen::Vector3d p = sample.position.cast<double>();
        const double range = p.norm();
        const Arc arc(std::asin((bent_pose.rotation * (p / range)).z()));
        CHECK(range == approx(1480.0 * arc.time_s()).epsilon(2e-4));
        CHECK(std::fabs(static_cast<double>(sample.height_m) / range + std::sin(arc.b)) < 2e-3);
        CHECK(static_cast<double>(-sample.normal.dot(sample.position)) / range ==
              approx(-std::sin(arc.b)).epsilon(5e-3));
        // Sound that spreads over W X / cos(a) for each solid angle, with W = dX / da sin(b),
        // has the power of range^2 by that, both ways.
        const double across = std::fabs(arc.slope() * std::sin(arc.b));
        const double share = range * range * std::cos(arc.a) / (across * arc.distance_m());
        CHECK(static_cast<double>(sample.strength) == approx(share * share).epsilon(2e-3));
    }
    // dA = X dX dazimuth, and dOmega = cos(a) da dazimuth, over the view.
    double true_area = 0.0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double azimuth = ((i + 0.5) / n - 0.5) * bent_view.azimuth_rad;
            const double elevation = ((j + 0.5) / n - 0.5) * bent_view.elevation_rad;
            const Eigen::Vector3d d = bent_pose.rotation * direction_of(azimuth, elevation);
            const Arc arc(std::asin(d.z()));
            true_area += arc.distance_m() * std::fabs(arc.slope()) / std::cos(arc.a) *
                         std::cos(elevation) * bent_view.azimuth_rad * bent_view.elevation_rad /
                         (n * n);
        }
    }
    CHECK(area_of(samples) == approx(true_area).epsilon(0.01));
}

TEST_CASE("bent rays: without a gradient they are straight, and ranges are times") {
    Scene scene = floor_under(0.0);
    const auto bent = engine_of(scene, EngineKind::rays);
    Scene still = scene;
    still.sound_profile = nullptr;
    const auto straight = engine_of(still, EngineKind::rays);
    View view = bent_view;
    const Samples with = bent->visible_surface(view, bent_pose);
    view.range_max_m *= 1500.0 / 1480.0;
    const Samples without = straight->visible_surface(view, bent_pose);
    // Every true place lies on the bottom, and the areas are about as large.
    for (const Sample& sample : with.items) {
        const Eigen::Vector3d p = bent_pose.rotation * sample.position.cast<double>();
        CHECK(1500.0 / 1480.0 * p.z() == approx(bent_bottom_m).epsilon(1e-4));
        CHECK(sample.strength == approx(std::pow(1480.0 / 1500.0, 4.0)).epsilon(1e-4));
    }
    // The area of a patch follows from its middle, and both have patches of their own.
    CHECK(area_of(with) == approx(area_of(without)).epsilon(0.01));
}

TEST_CASE("bent rays: sound that bends down sees what a sill hides from a line") {
    // Speed that falls with depth bends sound down: half way to a point 100 m ahead the arc
    // passes 0.25 m above the line to it, and over a sill that is 0.1 m above the line.
    for (const double gradient : {bent_gradient, -bent_gradient}) {
        Scene scene = floor_under(gradient);
        add_rectangle(scene, {50.0F, -5.0F, -60.0F}, {50.0F, 5.0F, -19.9F},
                      add_material(scene, 0.5F));
        const auto engine = engine_of(scene, EngineKind::rays);
        const Samples samples = engine->visible_surface(bent_view, bent_pose);
        bool is_visible = false;
        for (const Sample& sample : samples.items) {
            const Eigen::Vector3d place =
                place_of(*scene.sound_profile, Eigen::Vector3d::Zero(),
                         bent_pose.rotation * sample.position.cast<double>().normalized(),
                         static_cast<double>(sample.position.norm()));
            is_visible |= std::fabs(place.z() - bent_bottom_m) < 0.1 &&
                          std::fabs(place.x() - 100.0) < 0.5 && std::fabs(place.y()) < 1.0;
        }
        CHECK(is_visible == (gradient > 0.0));
    }
}

TEST_CASE("bent rays: a sight line goes on behind what it met") {
    const Scene scene = floor_under(bent_gradient);
    const auto engine = engine_of(scene, EngineKind::rays);
    const Eigen::Vector3f direction = Eigen::Vector3f::UnitX();
    const auto distances_from = [&](float range_m) {
        const Ray ray{range_m * direction, direction};
        std::vector<float> out;
        engine->pass_surfaces(bent_pose, {&ray, 1}, 200.0F,
                              [&](std::size_t, std::span<const Intersection> met) {
                                  for (const Intersection& one : met)
                                      out.push_back(one.distance_m);
                              });
        return out;
    };
    const std::vector<float> first = distances_from(0.0F);
    REQUIRE(first.size() == 1);
    CHECK(distances_from(30.0F).at(0) + 30.0F == approx(first[0]).epsilon(1e-5));
    CHECK(distances_from(1.001F * first[0]).empty());
}
