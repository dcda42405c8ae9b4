#include "visibility/strips/fixtures.h"

namespace {

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

View view_of(ViewShape shape) {
    View view{radians(70.0), radians(30.0), 0.0, 20.0, 256, 64, 0.03, shape};
    if (shape == ViewShape::port_starboard) {
        view.elevation_rad = radians(2.0);
        view.azimuth_rad = radians(160.0);
        view.beams = 2;
    } else if (shape == ViewShape::cone) {
        view.elevation_rad = view.azimuth_rad;
        view.beams = 1;
    }
    return view;
}

/// Solid angle of azimuth times the integral over elevation. For a cone: 2 pi (1 - cos).
double solid_angle(const View& view) {
    if (view.shape == ViewShape::cone) return 2.0 * pi * (1.0 - std::cos(0.5 * view.azimuth_rad));
    return 2.0 * view.azimuth_rad * std::sin(0.5 * view.elevation_rad);
}

}  // namespace

// If energies add, an engine must neither lose nor invent surface: dOmega = cosine dA / r^2, with
// cosine = h / r, must add up to the solid angle of a view that a room fills.
TEST_CASE("a room fills the solid angle of a view, thin objects included") {
    const Scene scene = room_with_poles();
    const Pose T_world_sensor{rotation_from_rpy(0.0, radians(15.0), 0.05), {0.1, 0.05, 0.2}};
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard, ViewShape::cone}) {
        for (const EngineKind type : {EngineKind::rays, EngineKind::strips}) {
            const View view = view_of(shape);
            const Samples samples = engine_of(scene, type)->visible_surface(view, T_world_sensor);
            const double share = filled_sr(samples) / solid_angle(view);
            CAPTURE_ALL(static_cast<int>(shape), static_cast<int>(type), share);
            CHECK(std::fabs(share - 1.0) < 0.005);
        }
    }
}
