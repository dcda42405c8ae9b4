#include "simulate/product/object_table.h"
#include "support/draws.h"
#include "support/labelled.h"

namespace {

/// The annotations of a scene on a floor.
struct FoundObjects {
    Sonar sonar;
    SceneObjects objects;
    std::unique_ptr<VisibilityEngine> engine;
    TracedPing traced;
    PingLabels labels;
    std::vector<ObjectInPing> visible;

    FoundObjects(const Scene& scene, const SonarConfig& config, const Pose& pose,
                 const std::vector<ObjectSphere>& spheres, bool all_shadows = false,
                 EngineKind kind = EngineKind::rays)
        : sonar(noise_free(config)),
          objects(objects_on_floor(scene)),
          engine(make_engine(scene, {.type = kind})),
          traced(trace(sonar, scene, *engine, pose, 0)) {
        labels = label_ping(
            traced, sonar.settings, scene, objects, *engine,
            {.objects = true, .shadow = all_shadows, .annotations = true, .annotated = spheres});
        visible = visible_objects(sonar, objects, traced, labels,
                                  form_image(traced, sonar.settings, scene, {}), {});
    }

    const ObjectInPing& object(std::uint32_t id) const {
        const auto found = std::ranges::find(visible, id, &ObjectInPing::id);
        REQUIRE(found != visible.end());
        return *found;
    }
};

/// Looks down at a floor at z = 0 from a height.
SonarConfig wide_fan() {
    SonarConfig config = small_imaging();
    set_fan(config, 60.0, 60.0, 240);
    set_range(config, config.range_min_m, 14.0, 700);
    return config;
}

}  // namespace

TEST_CASE("annotations: the azimuth of an object astern, in a full turn") {
    for (const float y : {0.0F, 0.4F, -0.4F}) {
        CAPTURE(y);
        Scene scene = floor_scene(30.0F, 0.0F, 0.5F);
        add_rectangle(scene, {-6, y - 1, 0}, {-6, y + 1, 2}, 0);
        SonarConfig config = wide_fan();
        config.azimuth_deg = 360.0;
        const FoundObjects found(scene, config, {.translation = {0.0, 0.0, 1.0}}, {});
        const double expected = std::atan2(static_cast<double>(y), -6.0);
        const double apart = *found.object(2).azimuth_rad - expected;
        CHECK(std::fabs(std::remainder(apart, 2.0 * pi)) < radians(1.5));
    }
}

TEST_CASE("annotations: the shadow of a wall on a flat floor is h r / (H - h) long") {
    // The line over a wall of height h at the distance r meets the floor at r H / (H - h).
    constexpr double sonar_m = 3.0;
    Uniform draw(7);
    for (int k = 0; k < 6; ++k) {
        const double h = draw.between(0.3, 1.2);
        const double r = draw.between(4.0, 6.5);
        CAPTURE_ALL(h, r);
        Scene scene = floor_scene(40.0F, 0.0F, 0.5F);
        const auto x = static_cast<float>(r);
        const auto top = static_cast<float>(h);
        add_rectangle(scene, {x, -0.3F, 0}, {x, 0.3F, top}, 0);
        // A wall and a box of the same front have the same shadow behind it.
        if (k % 2 == 1) add_box(scene, {x, -0.3F, 0}, {x + 0.2F, 0.3F, top}, 0);
        const FoundObjects found(scene, wide_fan(), pitched(25.0, {0.0, 0.0, sonar_m}),
                                 {ObjectSphere{{r, 0.0, 0.5 * h}, 0.5 * h + 0.5}}, true);
        const ObjectInPing& wall = found.object(2);
        const double end_m = std::hypot(r * sonar_m / (sonar_m - h), sonar_m);
        const double bin_m = found.sonar.settings.view.bin_m();
        CHECK(std::fabs(found.sonar.range_edges_m[wall.shadow.last_bin + 1] - end_m) < 2.5 * bin_m);
        CHECK(wall.shadow.first_bin >= wall.range_first);
        // Exact coverage by triangles finds the same bins, which have no other owner.
        const auto exact = static_cast<double>(std::ranges::count(found.labels.shadow, 2));
        CHECK(static_cast<double>(wall.shadow_bins) == approx(exact).epsilon(0.01));
        // From its upper edge to its lower corners.
        CHECK(wall.range_m > std::hypot(r, sonar_m - h));
        CHECK(wall.range_m < std::hypot(r, 0.3, sonar_m));
        CHECK(wall.contrast_db.has_value());
        // The echo of the wall at its foot has the cosine of the angle below the horizon, that of
        // the floor the sine; the bins of the wall hold floor as well.
        CHECK(*wall.contrast_db > 0.5);
        CHECK(*wall.contrast_db < 10.0 * std::log10(r / (sonar_m - h)) + 0.3);
        REQUIRE(wall.shadow_contrast_db.has_value());
        CHECK(*wall.shadow_contrast_db < -6.0);
        CHECK(std::fabs(wall.azimuth_rad.value()) < 0.02);
    }
}

TEST_CASE("annotations: a shadow ends with the first ground behind the object") {
    // A quay that ends behind the wall's shadow on it. The ground a metre below is hidden by the
    // quay, although lines through the wall lead there, too.
    Uniform draw(3);
    for (int k = 0; k < 6; ++k) {
        const double h = draw.between(0.3, 1.2);
        const double r = draw.between(3.0, 5.0);
        const double end_m = 3.0 * r / (3.0 - h);
        Scene scene = floor_scene(40.0F, -1.0F, 0.5F);
        const auto edge = static_cast<float>(end_m + 0.3);
        add_triangle(scene, {-40, -40, 0}, {edge, -40, 0}, {edge, 40, 0}, 0);
        add_triangle(scene, {-40, -40, 0}, {edge, 40, 0}, {-40, 40, 0}, 0);
        const auto x = static_cast<float>(r);
        add_rectangle(scene, {x, -0.3F, 0}, {x, 0.3F, static_cast<float>(h)}, 0);
        const FoundObjects found(scene, wide_fan(), pitched(25.0, {0.0, 0.0, 3.0}),
                                 {ObjectSphere{{r, 0.0, 0.5 * h}, 0.5 * h + 0.5}}, k % 2 == 1);
        const int last_bin = found.object(2).shadow.last_bin;
        CHECK(std::fabs(found.sonar.range_edges_m[last_bin + 1] - std::hypot(end_m, 3.0)) < 0.06);
    }
}

TEST_CASE("annotations: a shadow begins at the surface that casts it") {
    // A plate at 5 m hides another one almost edge-on, whose footprints reach far along the range.
    Scene scene = floor_scene(40.0F, -9.0F, 0.5F);
    const auto plate = [&](float x0, float y0, float x1, float y1) {
        add_quad(scene, {x0, y0, -0.3F}, {x1, y1, -0.3F}, {x1, y1, 0.3F}, {x0, y0, 0.3F}, 0);
    };
    plate(5.0F, -0.3F, 5.0F, 0.3F);
    plate(5.01F, -0.02F, 8.0F, 0.06F);
    const std::vector<ObjectSphere> spheres{{{5.0, 0.0, 0.0}, 0.5}, {{6.5, 0.0, 0.0}, 1.6}};
    const FoundObjects found(scene, wide_fan(), {}, spheres, true);
    const double bin_m = found.sonar.settings.view.bin_m();
    const double begin_m = found.sonar.range_edges_m[found.object(2).shadow.first_bin];
    CHECK(begin_m > 5.0 - 0.5 * bin_m);
    CHECK(begin_m < 5.2);
    int before = 0;
    for (std::size_t k = 0; k < found.labels.size(); ++k) {
        const double end_m = found.sonar.range_edges_m[k % found.labels.range_bins + 1];
        before += end_m < 5.0 && (found.labels.shadow[k] > 1 || found.labels.object_shadow[k] > 1);
    }
    CHECK(before == 0);
}

TEST_CASE("annotations: visible shares are those of all sight lines, and the shadows are, too") {
    // Spheres at random, some behind others and some half in the floor.
    Uniform draw(3);
    double both = 0.0;
    double either = 0.0;
    int partly_hidden = 0;
    for (int n = 0; n < 4; ++n) {
        Scene scene = floor_scene(40.0F, 0.0F, 0.5F);
        std::vector<ObjectSphere> spheres;
        for (int k = 0; k < 12; ++k) {
            const Eigen::Vector3f centre(draw.single(3.0, 9.0), draw.single(-3.0, 3.0),
                                         draw.single(-0.1, 0.6));
            const float radius = draw.single(0.1, 0.5);
            add_sphere(scene, centre, radius, 0, 24);
            spheres.push_back({centre.cast<double>(), 1.0001 * radius});
        }
        const FoundObjects found(scene, wide_fan(), pitched(25.0, {0.0, 0.0, 3.0}), spheres, true);
        // The box lets lines end where they leave the scene.
        const Eigen::AlignedBox3d surface(Eigen::Vector3d(-40, -40, -0.6),
                                          Eigen::Vector3d(40, 40, 1.1));
        const PingLabels few = label_ping(
            found.traced, found.sonar.settings, scene, found.objects, *found.engine,
            {.objects = true, .annotations = true, .annotated = spheres, .surface = &surface});
        for (std::size_t k = 1; k < few.visible_share.size(); ++k) {
            CAPTURE(k);
            const float all = found.labels.visible_share[k];
            CHECK(std::isnan(all) == std::isnan(few.visible_share[k]));
            if (std::isnan(all)) continue;
            CHECK(few.visible_share[k] == all);
            partly_hidden += all > 0.0F && all < 0.95F;
        }
        CHECK(few.object_shadow == found.labels.object_shadow);
        for (std::size_t k = 0; k < few.object_shadow.size(); ++k) {
            const std::uint16_t all_finder =
                found.labels.shadow[k] > 1 ? found.labels.shadow[k] : 0;
            both += all_finder != 0 && few.object_shadow[k] != 0;
            either += all_finder != 0 || few.object_shadow[k] != 0;
        }
    }
    CHECK(partly_hidden > 5);
    CHECK(both / either > 0.97);
}

TEST_CASE("annotations: a thick box in open water before a plate, and a strip beyond the range") {
    // The rectangle from 0 to (y, z) at the distance d has the solid angle atan(y z / (d r)), with
    // r^2 = d^2 + y^2 + z^2. The box at 2 m hides the plate's part with |y| < 0.6 and z < 1.5.
    const auto upper = [](double y, double z) {
        return 2.0 * std::atan(y * z / (6.0 * std::hypot(6.0, y, z)));
    };
    const auto above = [&](double y) { return upper(y, 1.5) - upper(y, 0.3); };
    Scene scene = floor_scene(40.0F, -30.0F, 0.5F);
    add_box(scene, {2, -0.2F, -0.5F}, {2.05F, 0.2F, 0.5F}, 0);
    std::ranges::replace_if(
        scene.triangle_instance, [](auto k) { return k > 1; }, 1U);
    add_rectangle(scene, {6, -1, 0.3F}, {6, 1, 1.5F}, 0);
    add_quad(scene, {1, 3, -0.3F}, {30, 3, -0.3F}, {30, 3.2F, -0.3F}, {1, 3.2F, -0.3F}, 0);
    SonarConfig config = wide_fan();
    set_range(config, config.range_min_m, 14.0, 120);  // samples are as large as bins allow
    const FoundObjects found(scene, config, {},
                             {{{2, 0, 0}, 1.0}, {{6, 0, 0.9}, 1.5}, {{15, 3, -0.3}, 16.0}}, true,
                             EngineKind::strips);
    CHECK(found.labels.visible_share[7] == approx(1.0 - above(0.6) / above(1.0)).epsilon(0.01));
    CHECK(found.object(9).box_sensor_m.max().x() ==
          approx(std::sqrt(14.0 * 14.0 - 9.0 - 0.09)).epsilon(0.002));
    int far_side = 0;
    for (std::size_t k = 0; k < found.labels.size(); ++k) {
        const double end_m = found.sonar.range_edges_m[k % found.labels.range_bins + 1];
        far_side += end_m < 5.5 && found.labels.object_shadow[k] == 2;
    }
    CHECK(far_side == 0);
}
