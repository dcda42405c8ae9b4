#include "simulate/reference/reference.h"

#include "support/calibrated.h"
#include "support/lattices.h"

namespace {

/// The visible area nearer and farther than 5 m, and the sum of cos(incidence) dA / r^2.
struct SurfaceSums {
    double near_m2 = 0.0;
    double far_m2 = 0.0;
    double solid_angle = 0.0;
};

SurfaceSums sums_over(const Scene& scene, int rays, std::uint32_t start) {
    const Caster caster(scene);
    const View view{radians(60.0), radians(60.0), 0.5, 8.0, 15, 16, 0.03};
    const Pose at_rest;
    SurfaceSums sums;
    cast_over_surface(
        {caster, scene, view, at_rest}, {rays, 256, start}, [&](const SurfacePoint& point) {
            (point.range_m < 5.0 ? sums.near_m2 : sums.far_m2) += point.area_m2;
            sums.solid_angle += point.area_m2 * point.cosine / (point.range_m * point.range_m);
        });
    return sums;
}

Sonar coarse_sonar(SonarKind kind) {
    SonarConfig config = calibrated(default_sonar(kind), 4e5);
    set_range(config, 0.5, 12.0, 96);
    config.azimuth_bins = 32;
    return make_sonar(config, {0.01});
}

}  // namespace

TEST_CASE("where two surfaces share a bin the reference weighs them by area") {
    // Two walls at one distance, R = 0.2 below the sonar, 0.8 above: the mean is 0.5 D / r.
    Scene scene = rectangle_scene({4, -9, -9}, {4, 9, 0}, 0.2F);
    add_rectangle(scene, {4, -9, 0}, {4, 9, 9}, add_material(scene, 0.8F));
    const Caster caster(scene);
    const View view{radians(40.0), radians(20.0), 0.5, 8.0, 200, 20, 0.03};
    const Reference reference = cast_reference(caster, scene, view, Pose{}, {0.004, 64.0});
    for (int j = 0; j < view.beams; ++j) {
        const int i = static_cast<int>((4.0 / std::cos(radians(-20.0 + 2.0 * (j + 0.5))) - 0.5) /
                                       view.bin_m()) +
                      1;
        const double r = view.range_min_m + (i + 0.5) * view.bin_m();
        CHECK(reference.intensity[i * 20 + j] == approx(0.5 * 4.0 / r).epsilon(5e-3));
    }
}

TEST_CASE("the reference sees a ball of 2 cm at 8 m and a wire of 4 mm at 5 m") {
    // Each lies in one bin. The mean of v . n by area is 1/2 for a distant ball, and 2 / pi for a
    // wire times cos(elevation), whose mean over |z| <= D t is asinh(t) / t.
    constexpr float R = 0.7F;
    Scene scene = empty_scene();
    const std::uint32_t material = add_material(scene, R);
    add_sphere(scene, {8.0F, 0.05F, 0.1F}, 0.01F, material, 64);
    constexpr float height = 0.6F;
    const double t = 0.5 * height / std::hypot(5.0, 0.3);
    add_pole(scene, {5.0F, -0.3F, -0.5F * height}, 0.002F, height, material);
    const Caster caster(scene);
    const double wire = R * 2.0 / pi * std::asinh(t) / t;
    const View fan{radians(60.0), radians(12.0), 0.96, 9.96, 150, 256, 0.03};
    View beam = fan;
    beam.beams = 1;
    View narrow = fan;
    narrow.azimuth_rad = radians(20.0);
    for (const View& view : {fan, beam, with_shape(narrow, ViewShape::cone),
                             with_shape(fan, ViewShape::port_starboard)}) {
        CAPTURE_ALL(static_cast<int>(view.shape), view.beams);
        // 64 rays per bin of a whole image are the minimum.
        const Reference reference = cast_reference(caster, scene, view, Pose{}, {0.01, 64.0});
        std::vector<float> occupied = reference.intensity;
        std::erase(occupied, 0.0F);
        REQUIRE(occupied.size() == 2);
        CHECK(occupied[0] / wire == approx(1.0).epsilon(0.01));
        CHECK(occupied[1] / (0.5 * R) == approx(1.0).epsilon(0.01));
        CHECK(reference.noise < 0.01);
    }
}

TEST_CASE("rays and points of the surface together add up to its area") {
    // Two plates that face the sonar, one behind the other. The near one hides 1.5 times its size.
    Scene plates = rectangle_scene({4, -0.3F, -0.3F}, {4, 0.1F, 0.2F}, 0.5F, 3);
    add_rectangle(plates, {6, -0.6F, -0.6F}, {6, 0.6F, 0.6F}, 0, 50);
    // A sphere at 4 m. The visible cap ends where sight lines touch it: its area is
    // 2 pi R^2 (1 - R / D), its solid angle 2 pi (1 - sqrt(1 - R^2 / D^2)).
    constexpr double R = 0.5;
    constexpr double D = 4.0;
    const Scene sphere = sphere_scene({D, 0, 0}, R, 0.5F, 200);
    for (const std::uint32_t start : {0U, 1U}) {
        CAPTURE(start);
        const SurfaceSums plate_sums = sums_over(plates, 64, start);
        CHECK(plate_sums.near_m2 / (0.4 * 0.5) == approx(1.0).epsilon(5e-3));
        CHECK(plate_sums.far_m2 / (1.2 * 1.2 - 0.6 * 0.75) == approx(1.0).epsilon(5e-3));
        const SurfaceSums sphere_sums = sums_over(sphere, 16, start);
        CHECK(sphere_sums.near_m2 / (2.0 * pi * R * R * (1.0 - R / D)) ==
              approx(1.0).epsilon(5e-3));
        CHECK(sphere_sums.solid_angle / (2.0 * pi * (1.0 - std::sqrt(1.0 - R * R / (D * D)))) ==
              approx(1.0).epsilon(5e-3));
    }
}

TEST_CASE("a reference sees copies of a mesh as it sees their triangles") {
    // A plate, two copies of a sphere in front of it, one twice as large, a third behind the sonar.
    Scene shared = empty_scene(Eigen::Vector3d(1e4, -2e4, 5.0));
    const std::uint32_t stone = add_material(shared, 0.5F);
    const std::uint32_t steel = add_material(shared, 0.9F);
    add_rectangle(shared, {6, -3, -3}, {6, 3, 3}, stone, 4);
    Scene copied = shared;
    Scene shape = empty_scene();
    add_sphere(shape, {0, 0, 0}, 0.4F, 0, 24);
    shared.shared_meshes.push_back({shape.vertices, shape.triangles,
                                    std::vector<std::uint32_t>(shape.triangles.size(), steel)});
    for (const auto& [place, scale] : {std::pair{Eigen::Vector3d(3.5, -0.8, 0.1), 1.0},
                                       {Eigen::Vector3d(4.2, 1.0, -0.2), 2.0},
                                       {Eigen::Vector3d(-4.0, 0.0, 0.0), 1.0}}) {
        const Eigen::Affine3d T_world_mesh = Eigen::Translation3d(shared.origin + place) *
                                             rotation_from_rpy(0.3, 0.2, 0.1) *
                                             Eigen::Scaling(scale);
        shared.copies.push_back({0, 0, T_world_mesh});
        const std::size_t first = copied.vertices.size();
        add_sphere(copied, {0, 0, 0}, 0.4F, steel, 24);
        for (std::size_t v = first; v < copied.vertices.size(); ++v)
            copied.vertices[v] =
                (T_world_mesh * copied.vertices[v].cast<double>() - shared.origin).cast<float>();
    }
    const View view{radians(60.0), radians(40.0), 0.5, 8.0, 75, 32, 0.03};
    const Pose pose{.translation = shared.origin};
    const ReferenceGoal goal{0.01, 64.0, 2'000'000};
    const Reference a = cast_reference(Caster(shared), shared, view, pose, goal);
    const Reference b = cast_reference(Caster(copied), copied, view, pose, goal);
    // The same rays to the same points; the corners differ by the rounding of a transform.
    CHECK(a.rays_per_bin / b.rays_per_bin == approx(1.0).epsilon(1e-3));
    CHECK(image_error(a.intensity, b.intensity).relative_l1 < 1e-3);
    CHECK(a.noise < 0.01);
    // Points on the copies' triangles find them, not only rays over directions.
    const LocalPose local = local_pose(pose, shared.origin);
    const std::vector<SurfaceShare> shares = surface_shares(shared, view, local);
    CHECK(std::ranges::count(shares, SurfaceShare::no_copy, &SurfaceShare::copy) == 32);
    CHECK(shares.size() == 32 + 2 * shape.triangles.size());
    CHECK(shares.size() == surface_shares(copied, view, local).size());
}

TEST_CASE("the distance of a reference's halves is about its error") {
    // More rays move the image by about as much as the halves of the smaller cast are apart.
    for (const std::uint32_t number : {2U, 13U}) {
        const Lattice lattice = draw_lattice(number);
        const Caster caster(lattice.scene);
        const View view = make_sonar(lattice.sonar, {}).settings.view;
        const auto by = [&](std::uint64_t rays) {
            return cast_reference(caster, lattice.scene, view, Pose{}, {0.0005, 16.0, rays});
        };
        const Reference few = by(200'000);
        const Reference many = by(1'600'000);
        CHECK(many.noise < few.noise);
        const double moved = image_error(few.intensity, many.intensity, many.scored).relative_l1;
        CHECK(moved < 1.5 * few.noise);
        CHECK(moved > 0.5 * few.noise);
    }
}

TEST_CASE("image errors by hand") {
    const std::vector<float> truth{1.0F, 1.0F, 0.0F, 0.0F};
    const std::vector<float> image{1.0F, 0.0F, 1.0F, 0.0F};
    CHECK(image_error(image, truth).relative_l1 == approx(1.0));
    CHECK(image_error(image, truth).miss_rate == approx(0.5));
    // The third bin, which the image alone fills, is not scored.
    const std::vector<std::uint8_t> scored{1, 1, 0, 1};
    CHECK(image_error(image, truth, scored).relative_l1 == approx(0.5));
    CHECK(image_error(image, truth, scored).miss_rate == approx(0.5));
    const std::vector<float> dark(4, 0.0F);
    CHECK(image_error(dark, dark).relative_l1 == 0.0);
    CHECK(image_error(image, dark).relative_l1 == 1.0);
}

// The rays represent a fully visible floor to within rounding, as many single points do.
TEST_CASE("the calibrated reference agrees with the engines") {
    Scene scene = floor_scene(30.0F, -4.0F, 0.4F, 4);
    add_sphere(scene, {5.0F, 0.5F, -3.5F}, 0.5F, 0, 48);
    const Caster caster(scene);
    Sonar hears_more = coarse_sonar(SonarKind::imaging);
    hears_more.settings.view.elevation_rad = radians(120.0);
    hears_more.settings.view.guards.count = hears_more.settings.view.beams / 2;
    for (const Sonar& sonar :
         {coarse_sonar(SonarKind::imaging), hears_more, coarse_sonar(SonarKind::sidescan),
          coarse_sonar(SonarKind::echosounder)}) {
        const SonarKind kind = sonar.config.kind;
        const Pose T_world_vehicle = pitched(kind == SonarKind::imaging ? 35.0 : 0.0);
        const Reference reference =
            cast_energy_reference(caster, scene, sonar.settings,
                                  sensor_pose(sonar, T_world_vehicle, 0), {0.01, 16.0, 30'000'000});
        const std::vector<float> image =
            expected_image(sonar, scene, EngineKind::rays, T_world_vehicle);
        const ImageError error = image_error(image, reference.intensity);
        CAPTURE_ALL(name_of(kind), sonar.settings.view.guards.count, reference.noise);
        CHECK(error.relative_l1 < 0.02 + reference.noise);
        CHECK(reference.noise < 0.03);
    }
}
