#include <iterator>

#include "hard/cases.h"

namespace sonarsim {

namespace {

void add_triangle(Scene& scene, const std::array<std::uint32_t, 3>& corners) {
    scene.triangles.push_back(corners);
    scene.triangle_material.push_back(0);
    scene.triangle_instance.push_back(0);
}

/// Triangles that are a point, a line, or folded onto themselves.
HardCase triangles_without_area() {
    Scene scene = plain_floor();
    add_triangle(scene, {0, 0, 0});
    add_triangle(scene, {0, 1, 1});
    add_triangle(scene, {0, 2, 0});
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const float x : {0.0F, 1.0F, 2.0F})
        scene.vertices.emplace_back(x, x, 1.0F);
    add_triangle(scene, {first, first + 1, first + 2});
    return {.name = "triangles without area",
            .scene = scene,
            .truth =
                [](const HardContext& context) {
                    return image_of(plain_floor(), context.trial, context.engine, context.model);
                },
            .bounds = {0.0, 1e-6},
            .truth_of_any_model = true};
}

/// A floor in strips; some are needles of 60 m by 60 micrometres.
HardCase needles() {
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.5F);
    constexpr float needle = 6e-5F;
    const float y[] = {-30.0F, -1.0F, -1.0F + needle, 0.0F, needle, 1.0F, 1.0F + needle, 30.0F};
    for (std::size_t i = 0; i + 1 < std::size(y); ++i)
        add_rectangle(scene, {-30, y[i], 0}, {30, y[i + 1], 0}, m);
    return {.name = "needle triangles", .scene = scene, .truth = floor_law, .bounds = {0.02}};
}

/// A changed tank that has the image of the tank with every echo model.
HardCase like_the_tank(const std::string& name, const Scene& scene, const HardBounds& bounds) {
    return {.name = name,
            .scene = scene,
            .starts_in_tank = true,
            .truth = tank_image,
            .bounds = bounds,
            .truth_of_any_model = true};
}

HardCase flipped_normals() {
    Scene scene = tank();
    for (std::size_t i = 0; i < scene.triangles.size(); i += 2)
        std::swap(scene.triangles[i][1], scene.triangles[i][2]);
    // Strips divide clipped triangles from another corner.
    return like_the_tank("flipped normals", scene, {0.01});
}

/// A floor in two halves, a tenth of a millimetre apart, whose vertices do not match.
HardCase cracked_floor() {
    Scene scene = rectangle_scene({-30, -30, 0}, {30, 0, 0}, 0.5F, 7);
    add_rectangle(scene, {-30, 1e-4F, 0}, {30, 30, 0}, 0, 10);
    return {.name = "T-junctions, a crack", .scene = scene, .truth = floor_law, .bounds = {0.02}};
}

HardCase thin_poles() {
    Scene scene = plain_floor();
    const std::uint32_t steel = add_material(scene, 0.9F);
    add_pole(scene, {3.0F, 0.6F, 0.0F}, 0.002F, 2.0F, steel, 8);
    add_pole(scene, {0.4F, 1.0F, 0.0F}, 0.002F, 1.0F, steel, 8);
    return {.name = "thin poles",
            .scene = scene,
            .truth = settled_reference,
            .bounds = {0.05},
            // A cone has a column of rays every 4 degrees, and a pole between two is not seen.
            .rays_fail = true};
}

HardCase triangle_of_10_km() {
    Scene scene = empty_scene();
    add_material(scene, 0.5F);
    scene.instances.push_back("sea floor");
    scene.vertices = {{-5000, -4000, 0}, {5000, -4000, 0}, {0, 6000, 0}};
    add_triangle(scene, {0, 1, 2});
    return {.name = "one triangle of 10 km", .scene = scene, .truth = floor_law, .bounds = {0.02}};
}

/// The tank with a change to every vertex.
template <class Change>
Scene tank_with(Change change) {
    Scene scene = tank();
    for (Eigen::Vector3f& p : scene.vertices)
        p = change(Eigen::Vector3d(p.cast<double>())).template cast<float>();
    return scene;
}

HardCase rigid_motion() {
    static const Pose motion{rotation_from_rpy(0.3, -0.2, 1.1), {20.0, -7.0, 3.0}};
    const Scene scene = tank_with([](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return motion.rotation * p + motion.translation;
    });
    HardCase hard = like_the_tank("rigid motion", scene, {2e-3, 0.01});
    hard.move = [](SonarKind, Pose& pose) { pose = motion * pose; };
    return hard;
}

/// UTM eastings and northings off the grid. Positions are rounded to float about an origin on a
/// grid of 10 m, as when a file is read.
HardCase in_utm() {
    static const Eigen::Vector3d utm(512345.678, 4812345.678, -43.21);
    const Eigen::Vector3d origin = 10.0 * (utm / 10.0).array().round().matrix();
    Scene scene =
        tank_with([&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + utm - origin; });
    scene.origin = origin;
    HardCase hard = like_the_tank("UTM, off the grid", scene, {1e-4, 1e-3});
    hard.move = [](SonarKind, Pose& pose) { pose.translation += utm; };
    return hard;
}

HardCase small_tank() {
    static constexpr double small = 1.25e-4;
    const Scene scene =
        tank_with([](const Eigen::Vector3d& p) -> Eigen::Vector3d { return small * p; });
    HardCase hard = like_the_tank("a tank of a millimetre", scene, {1e-4});
    hard.change = [](SonarConfig& c) {
        c.range_min_m *= small;
        c.range_max_m *= small;
    };
    hard.move = [](SonarKind, Pose& pose) { pose.translation *= small; };
    hard.truth_of_any_model = false;
    return hard;
}

/// y -> -y swaps port and starboard and reverses the sense of roll and yaw.
HardCase mirror() {
    const Scene scene =
        tank_with([](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); });
    HardCase hard = like_the_tank("mirror", scene, {0.01});
    hard.move = [](SonarKind, Pose& pose) {
        pose.translation.y() = -pose.translation.y();
        pose.rotation.x() = -pose.rotation.x();
        pose.rotation.z() = -pose.rotation.z();
    };
    hard.truth = [](const HardContext& context) {
        std::vector<float> image = tank_image(context);
        for (auto row = image.begin(); row != image.end(); row += context.ping.beams)
            std::reverse(row, row + context.ping.beams);
        return image;
    };
    return hard;
}

/// A fixed permutation: 7919 and the number of triangles are coprime.
HardCase permuted_triangles() {
    const Scene in_order = tank();
    Scene scene = in_order;
    const std::size_t count = scene.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = i * 7919 % count;
        scene.triangles[i] = in_order.triangles[from];
        scene.triangle_material[i] = in_order.triangle_material[from];
        scene.triangle_instance[i] = in_order.triangle_instance[from];
    }
    return like_the_tank("permuted triangles", scene, {1e-6});
}

}  // namespace

std::vector<HardCase> hard_geometry() {
    return {triangles_without_area(), needles(),    flipped_normals(),
            cracked_floor(),          thin_poles(), triangle_of_10_km()};
}

std::vector<HardCase> hard_invariances() {
    return {rigid_motion(), in_utm(), small_tank(), mirror(), permuted_triangles()};
}

}  // namespace sonarsim
