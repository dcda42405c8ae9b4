#include "hard/cases.h"

namespace sonarsim {

namespace {

using namespace shapes;

/// The tank with a change to every vertex.
template <class Change>
Scene tank_with(Change change) {
    Scene scene = tank();
    for (Eigen::Vector3f& p : scene.vertices)
        p = change(Eigen::Vector3d(p.cast<double>())).template cast<float>();
    return scene;
}

const Pose motion{rotation_from_rpy(0.3, -0.2, 1.1), {20.0, -7.0, 3.0}};

Scene rigidly_moved() {
    return tank_with([](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return motion.rotation * p + motion.translation;
    });
}

HardTrial rigidly_moved_trial(SonarKind kind) {
    HardTrial trial = in_tank(kind);
    trial.T_world_vehicle = motion * trial.T_world_vehicle;
    return trial;
}

/// UTM eastings and northings off the grid.
const Eigen::Vector3d utm(512345.678, 4812345.678, -43.21);

/// Positions are rounded to float about an origin on a grid of 10 m, as when a file is read.
Scene in_utm() {
    const Eigen::Vector3d origin = 10.0 * (utm / 10.0).array().round().matrix();
    Scene scene =
        tank_with([&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + utm - origin; });
    scene.origin = origin;
    return scene;
}

HardTrial in_utm_trial(SonarKind kind) {
    HardTrial trial = in_tank(kind);
    trial.T_world_vehicle.translation += utm;
    return trial;
}

constexpr double small = 1.25e-4;

Scene scaled() {
    return tank_with([](const Eigen::Vector3d& p) -> Eigen::Vector3d { return small * p; });
}

HardTrial scaled_trial(SonarKind kind) {
    HardTrial trial = in_tank(kind, [](SonarConfig& c) {
        c.range_min_m *= small;
        c.range_max_m *= small;
    });
    trial.T_world_vehicle.translation *= small;
    return trial;
}

Scene mirrored() {
    return tank_with(
        [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); });
}

/// y -> -y reverses the sense of roll and yaw.
HardTrial mirrored_trial(SonarKind kind) {
    HardTrial trial = in_tank(kind);
    Pose& pose = trial.T_world_vehicle;
    pose.translation.y() = -pose.translation.y();
    pose.rotation.x() = -pose.rotation.x();
    pose.rotation.z() = -pose.rotation.z();
    return trial;
}

/// Swaps port and starboard.
std::vector<float> mirrored_image(const HardContext& context) {
    std::vector<float> image = tank_image(context);
    for (auto row = image.begin(); row != image.end(); row += context.ping.beams)
        std::reverse(row, row + context.ping.beams);
    return image;
}

/// A fixed permutation: 7919 and the number of triangles are coprime.
Scene permuted() {
    const Scene in_order = tank();
    Scene scene = in_order;
    const std::size_t count = scene.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = i * 7919 % count;
        scene.triangles[i] = in_order.triangles[from];
        scene.triangle_material[i] = in_order.triangle_material[from];
        scene.triangle_instance[i] = in_order.triangle_instance[from];
    }
    return scene;
}

}  // namespace

std::vector<HardCase> hard_invariances() {
    return {{.name = "rigid motion",
             .scene = rigidly_moved,
             .trial = rigidly_moved_trial,
             .truth = tank_image,
             .bounds = {2e-3, 0.01},
             .truth_of_any_model = true},
            {.name = "UTM, off the grid",
             .scene = in_utm,
             .trial = in_utm_trial,
             .truth = tank_image,
             .bounds = {1e-4, 1e-3},
             .truth_of_any_model = true},
            {.name = "a tank of a millimetre",
             .scene = scaled,
             .trial = scaled_trial,
             .truth = tank_image,
             .bounds = {1e-4}},
            {.name = "mirror",
             .scene = mirrored,
             .trial = mirrored_trial,
             .truth = mirrored_image,
             .bounds = {0.01},
             .truth_of_any_model = true},
            {.name = "permuted triangles",
             .scene = permuted,
             .trial = [](SonarKind kind) { return in_tank(kind); },
             .truth = tank_image,
             .bounds = {1e-6},
             .truth_of_any_model = true}};
}

}  // namespace sonarsim
