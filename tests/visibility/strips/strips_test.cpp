#include "simulate/reference/reference.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/lattices.h"
#include "visibility/strips/fixtures.h"

namespace {

/// The wall x = `x`, 40 m across, of n x n x 2 triangles.
Scene wall_ahead(float x, int n = 1) {
    return rectangle_scene({x, -20, -20}, {x, 20, 20}, 0.5F, n);
}

/// A closed room with objects narrower than a beam.
Scene room_with_poles() {
    Scene scene = empty_scene();
    const std::uint32_t material = add_material(scene, 0.5F);
    add_box(scene, {-6.0F, -5.0F, -2.0F}, {6.0F, 5.0F, 2.0F}, material);
    for (int i = 0; i < 12; ++i) {
        const auto place = static_cast<float>(i);
        add_pole(scene, {2.0F + 0.2F * place, -2.2F + 0.4F * place, -2.0F}, 0.01F, 3.0F, material,
                 8);
    }
    add_sphere(scene, {2.5F, 0.3F, -1.0F}, 0.4F, material, 32);
    return scene;
}

}  // namespace

// If energies add, an engine must neither lose nor invent surface: dOmega = cosine dA / r^2, with
// cosine = h / r, must add up to the solid angle of a view that a room fills.
TEST_CASE("a room fills the solid angle of a view, thin objects included") {
    const Scene scene = room_with_poles();
    const Pose T_world_sensor{rotation_from_rpy(0.0, radians(15.0), 0.05), {0.1, 0.05, 0.2}};
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard, ViewShape::cone}) {
        const bool sides = shape == ViewShape::port_starboard;
        const View view = with_shape(
            {radians(sides ? 160.0 : 70.0), radians(sides ? 2.0 : 30.0), 0.0, 20.0, 256, 64, 0.03},
            shape);
        for (const EngineKind type : {EngineKind::rays, EngineKind::strips}) {
            const Samples samples = engine_of(scene, type)->visible_surface(view, T_world_sensor);
            // Azimuth times the integral over elevation; for a cone 2 pi (1 - cos).
            const double whole = shape == ViewShape::cone
                                     ? 2.0 * pi * (1.0 - std::cos(0.5 * view.azimuth_rad))
                                     : 2.0 * view.azimuth_rad * std::sin(0.5 * view.elevation_rad);
            const double share = filled_sr(samples) / whole;
            CAPTURE_ALL(static_cast<int>(shape), static_cast<int>(type), share);
            CHECK(std::fabs(share - 1.0) < 0.005);
        }
    }
}

TEST_CASE("strips: two large triangles fill the range") {
    // A plane at the distance d has the disc of pi (R^2 - d^2) within the range R. Its corners are
    // out of range, and so are the ends of most columns. Samples end two bins later.
    Uniform random(3);
    const View view = fan_view(130.0, 150.0);
    const double R = view.range_max_m + 2.0 * view.bin_m();
    for (int trial = 0; trial < 10; ++trial) {
        const double d = random.between(0.6, 0.95) * view.range_max_m;
        CAPTURE(d);
        Scene scene = wall_ahead(0.0F);
        const double pitch = radians(random.between(-10.0, 10.0));
        const double yaw = radians(random.between(-10.0, 10.0));
        for (Eigen::Vector3f& v : scene.vertices) {
            const Eigen::Vector3d ahead =
                v.cast<double>() * view.range_max_m + d * Eigen::Vector3d::UnitX();
            v = (rotation_from_rpy(0.0, pitch, yaw) * ahead).cast<float>();
        }
        const double area = std::numbers::pi * (R * R - d * d);
        CHECK(area_of(visible(scene, view)) == approx(area).epsilon(5e-3));
    }
}

TEST_CASE("strips: a cone sees a disc, however narrow it is") {
    // A plane at d across the boresight: pi (d tan(opening / 2))^2.
    for (const double opening_deg : {140.0, 60.0, 0.3, 0.05}) {
        CAPTURE(opening_deg);
        View view = with_shape(fan_view(opening_deg), ViewShape::cone);
        view.range_max_m = 60.0;
        const double radius = 4.0 * std::tan(radians(0.5 * opening_deg));
        const double error = opening_deg < 1.0 ? 0.02 : 0.01;
        for (const int n : {1, 40}) {
            if (n > 1 && opening_deg < 1.0) continue;
            CHECK(area_of(visible(wall_ahead(4.0F, n), view)) ==
                  approx(pi * radius * radius).epsilon(error));
        }
    }
}

TEST_CASE("strips: full turns and steep views see all of a sphere around the sonar") {
    const Scene scene = sphere_scene({0, 0, 0}, 3.0F, 0.5F, 128);
    for (const double elevation_deg : {180.0, 120.0, 60.0}) {
        const double expected = 36.0 * pi * sincos(0.5 * radians(elevation_deg)).sin;
        for (const int beams : {1, 2, 3, 64, 1000}) {
            CAPTURE_ALL(elevation_deg, beams);
            const Samples samples = visible(scene, fan_view(360.0, elevation_deg, beams));
            CHECK(area_of(samples) == approx(expected).epsilon(0.01));
            // Columns meet at the poles of a view of 180 degrees.
            const double tolerance = elevation_deg > 120.0 ? 0.15 : 0.02;
            for (int j = 0; j < beams; ++j)
                CHECK(area_of(samples.beam(j)) == approx(expected / beams).epsilon(tolerance));
        }
    }
}

TEST_CASE("strips: planes that cross are each seen where they are nearest, equal planes once") {
    // Planes through (5, y, 0) that lean by -1, 0 and 1: the outer two are nearer above and below.
    Scene scene = empty_scene();
    std::array<std::uint32_t, 3> material;
    for (int k = 0; k < 3; ++k) {
        const auto lean = static_cast<float>(k - 1);
        material[k] = add_material(scene, 0.3F + 0.1F * static_cast<float>(k));
        for (int twice = 0; twice < 2; ++twice)
            add_quad(scene, {5 - 4 * lean, -9, -4}, {5 - 4 * lean, 9, -4}, {5 + 4 * lean, 9, 4},
                     {5 + 4 * lean, -9, 4}, material[k]);
    }
    std::array<double, 3> area{};
    double wrong = 0.0;
    const Samples samples = visible(scene, fan_view());
    for (const Sample& sample : samples.items) {
        const auto k = std::ranges::find(material, sample.material) - material.begin();
        area[k] += static_cast<double>(sample.area_m2);
        // The plane that leans towards the sonar above z = 0 has normal.z > 0.
        if (k != 1 && sample.position.z() * static_cast<float>(1 - k) < -1e-4F)
            wrong += static_cast<double>(sample.area_m2);
    }
    CHECK(area[1] < 1e-4);
    CHECK(area[0] > 1.0);
    CHECK(wrong < 1e-3 * area[0]);
    CHECK(area[2] / area[0] == approx(1.0).epsilon(1e-3));
    const double solid = 2.0 * fan_view().azimuth_rad * sincos(0.5 * fan_view().elevation_rad).sin;
    CHECK(filled_sr(samples) == approx(solid).epsilon(2e-3));
}

TEST_CASE("strips: where faces coincide the first of the file is seen") {
    // A plate in a floor: the plate before the floor is seen, and behind it hidden.
    for (const bool plate_first : {true, false}) {
        Scene scene = empty_scene();
        const std::uint32_t sand = add_material(scene, 0.2F);
        const std::uint32_t steel = add_material(scene, 0.9F);
        const auto add = [&](float x0, float x1, float y, std::uint32_t material) {
            add_rectangle(scene, {x0, -y, -2}, {x1, y, -2}, material);
        };
        if (plate_first) add(5, 7, 1, steel);
        add(1, 40, 30, sand);
        if (!plate_first) add(5, 7, 1, steel);
        double steel_m2 = 0.0;
        for (const Sample& sample : visible(scene, fan_view(), pitched(15.0)).items)
            steel_m2 += sample.material == steel ? static_cast<double>(sample.area_m2) : 0.0;
        CHECK(steel_m2 == approx(plate_first ? 4.0 : 0.0).epsilon(1e-3));
    }
}

TEST_CASE("strips: two wide beams have the surface of rods that stand in each of them") {
    // Beams of 150 degrees. The reference has 64 beams in place of each.
    Uniform random(5);
    const View view = fan_view(300.0, 20.0, 2);
    View narrow = fan_view(300.0, 20.0, 128);
    narrow.relative_l1 = 0.003;
    for (int k = 0; k < 8; ++k) {
        Scene scene = empty_scene();
        const std::uint32_t rock = add_material(scene, 0.5F);
        for (int rod = 0; rod < 60; ++rod) {
            const float turn = random.single(-3.1, 3.1);
            const float range = random.single(3.0, 9.0);
            add_pole(scene, {range * std::cos(turn), range * std::sin(turn), -0.3F}, 0.05F, 0.6F,
                     rock, 6);
        }
        const Samples image = visible(scene, view);
        const Samples reference = visible(scene, narrow);
        for (const int beam : {0, 1}) {
            CAPTURE(beam);
            double expected = 0.0;
            for (int j = 64 * beam; j < 64 * beam + 64; ++j)
                expected += area_of(reference.beam(j));
            CHECK(area_of(image.beam(beam)) == approx(expected).epsilon(0.02));
        }
    }
}

// Far sides of solids are left out. Without that they are hidden.
TEST_CASE("strips: drawn solids look the same as open meshes, whichever way their normals point") {
    Uniform random(11);
    const View view = fan_view(120.0, 60.0, 32);
    for (int trial = 0; trial < 12; ++trial) {
        Scene scene = room_with_poles();
        for (int k = 0; k < 6; ++k) {
            const std::size_t first = scene.triangles.size();
            const auto place = [&](float size) -> Eigen::Vector3f {
                return {random.single(0.5, 4.0), size * random.single(-3.0, 3.0),
                        size * random.single(-1.0, 1.0)};
            };
            const Eigen::Vector3f low = place(1.0F);
            if (k % 2 == 0)
                add_box(scene, low, low + Eigen::Vector3f(0.2F, 0.7F, random.single(0.2, 1.0)), 0);
            else
                add_bar(scene, low, place(0.5F), random.single(0.01, 0.3), 7, true, 0);
            // Every third part is inside out.
            for (std::size_t i = first; k % 3 == 0 && i < scene.triangles.size(); ++i)
                std::swap(scene.triangles[i][0], scene.triangles[i][1]);
        }
        for (Eigen::Vector3f& vertex : scene.vertices)  // edges meet exactly
            vertex = (1024.0F * vertex.array()).round() / 1024.0F;
        // The room, its ball and four others. Poles have no caps.
        const Solids solids = find_solids(scene.vertices, scene.triangles);
        CHECK(std::ranges::count(solids.items, 1.0F, &Solid::outward) == 6);
        CHECK(std::ranges::count(solids.items, -1.0F, &Solid::outward) == 2);
        const SceneClusters clusters(scene);
        const Pose pose{rotation_from_rpy(0.0, 0.2, 0.1), {0.1, 0.05, 0.2}};
        ClustersInView in_view = clusters.in_view(view, pose, {});
        const Samples near_sides = strips_surface(in_view, view);
        std::ranges::fill(in_view.own_outward, 0.0F);
        const Samples both_sides = strips_surface(in_view, view);
        for (int j = 0; j < view.beams; ++j) {
            CAPTURE_ALL(trial, j);
            CHECK(filled_sr(near_sides, j, j + 1) ==
                  approx(filled_sr(both_sides, j, j + 1)).epsilon(1e-4));
        }
    }
}

TEST_CASE(
    "solids: bodies that share a corner and are turned differently are none, nor what crosses "
    "itself") {
    Scene two = box_scene({0, 0, 0}, {1, 1, 1}, 0.5F);
    add_box(two, {1, 1, 1}, {1.5F, 1.6F, 1.7F}, 0);
    CHECK(find_solids(two.vertices, two.triangles).items.size() == 2);
    for (auto triangle = two.triangles.begin() + 12; triangle != two.triangles.end(); ++triangle)
        std::swap((*triangle)[0], (*triangle)[1]);
    CHECK(find_solids(two.vertices, two.triangles).items.size() == 1);
    // A part of the top lies below the bottom.
    Scene block = box_scene({0, 0, 0}, {1, 1, 1}, 0.5F);
    for (Eigen::Vector3f& vertex : block.vertices) {
        if (vertex == Eigen::Vector3f(1, 1, 1)) vertex.z() = -0.6F;
    }
    CHECK(find_solids(block.vertices, block.triangles).items.size() == 1);
}

TEST_CASE("strips: footprints tile the ground, and their areas are the surface's") {
    // Bumpy ground that hides parts of itself.
    Scene scene = empty_scene();
    const std::uint32_t rock = add_material(scene, 0.5F);
    for (int k = 0; k < 40; ++k) {
        const auto at = static_cast<float>(k);
        add_sphere(scene, {3.0F + 0.15F * at, 2.5F * std::sin(1.7F * at), -1.0F}, 0.1F + 0.01F * at,
                   rock, 24);
    }
    add_rectangle(scene, {0, -9, -1}, {14, 9, -1}, rock, 80);
    View view = fan_view();
    const Pose pose{rotation_from_rpy(0.0, radians(12.0), 0.1), {0.0, 0.0, 0.3}};
    const Samples usual = visible(scene, view, pose);
    double own = 0.0;
    for (const Sample& sample : usual.items)
        own += static_cast<double>(4.0F * sample.edge_u.cross(sample.edge_v).norm());
    const double area = area_of(usual);
    CHECK(own / area == approx(1.0).epsilon(0.005));
    view.relative_l1 = 0.003;
    CHECK(area / area_of(visible(scene, view, pose)) == approx(1.0).epsilon(0.01));
}

TEST_CASE("strips: drawn lattices are within their error goals") {
    const auto error = [](std::uint32_t number, double goal, const ReferenceGoal& of_truth) {
        const Lattice lattice = draw_lattice(number);
        Sonar sonar = noise_free(lattice.sonar, goal);
        sonar.T_vehicle_sensor = Pose{};
        return error_without_noise(expected_image(sonar, lattice.scene, EngineKind::strips),
                                   cast_reference(Caster(lattice.scene), lattice.scene,
                                                  sonar.settings.view, Pose{}, of_truth));
    };
    for (const double goal : {0.03, 0.01}) {  // means over the scenes; single ones exceed them
        double mean = 0.0;
        int count = 0;
        for (std::uint32_t number = 0; number < 24; number += goal < 0.02 ? 3 : 1) {
            const double off =
                error(number, goal, {0.25 * goal, 8.0, goal < 0.02 ? 4'000'000U : 1'000'000U});
            CAPTURE_ALL(goal, number, off);
            CHECK(off < 3.0 * goal);
            mean += off;
            ++count;
        }
        CHECK(mean / count < goal);
    }
    // Posts of stairs and rails of a ladder that are narrower than a column, for profiling sonars.
    CHECK(error(257, 0.1, {0.0005, 16.0, 400'000}) < 0.11);
    CHECK(error(145, 0.03, {0.0005, 16.0, 400'000}) < 0.045);
}

TEST_CASE("strips: a patch as narrow as rounding has a finite place") {
    // A net below an echosounder. The mean of two triangles without area was no number.
    const Lattice lattice = draw_lattice(14253);
    const auto engine = engine_of(lattice.scene, EngineKind::strips);
    const View view = make_sonar(lattice.sonar, {0.1}).settings.view;
    for (const Sample& sample : engine->visible_surface(view, Pose{}).items)
        CHECK(sample.position.allFinite());
}
