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
    const bool sides = shape == ViewShape::port_starboard;
    const double azimuth_rad = radians(sides ? 160.0 : 70.0);
    const double elevation_rad = radians(sides ? 2.0 : 30.0);
    return with_shape({azimuth_rad, elevation_rad, 0.0, 20.0, 256, 64, 0.03}, shape);
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
