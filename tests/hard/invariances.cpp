#include <algorithm>
#include <array>
#include <utility>

#include "hard/tools.h"
#include "support/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

const Pose motion{rotation_from_rpy(0.3, -0.2, 1.1), {20.0, -7.0, 3.0}};

std::vector<float> unmoved_tank_image(const HardContext& context) {
    return image_of(tank(), in_tank(context.kind), context.engine, context.model);
}

Scene rigidly_moved() {
    Scene scene = tank();
    for (Eigen::Vector3f& p : scene.vertices)
        p = (motion.rotation * p.cast<double>() + motion.translation).cast<float>();
    return scene;
}

HardTrial rigidly_moved_trial(SonarKind kind) {
    HardTrial trial = in_tank(kind);
    trial.T_world_vehicle = motion * trial.T_world_vehicle;
    return trial;
}

Scene mirrored() {
    Scene scene = tank();
    for (Eigen::Vector3f& p : scene.vertices)
        p.y() = -p.y();
    return scene;
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
    std::vector<float> image = unmoved_tank_image(context);
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
             .stresses = "scene and trajectory moved and turned",
             .scene = rigidly_moved,
             .trial = rigidly_moved_trial,
             .truth = unmoved_tank_image,
             .bounds = {0.01},
             .truth_of_any_model = true},
            {.name = "mirror",
             .stresses = "y -> -y",
             .scene = mirrored,
             .trial = mirrored_trial,
             .truth = mirrored_image,
             .bounds = {0.01},
             .truth_of_any_model = true},
            {.name = "permuted triangles",
             .stresses = "another order",
             .scene = permuted,
             .trial = plain_sonar_in_tank,
             .truth = unmoved_tank_image,
             .bounds = {1e-6},
             .truth_of_any_model = true}};
}

}  // namespace sonarsim
