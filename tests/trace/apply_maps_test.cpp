#include "simulate/trace/apply_maps.h"

#include "support/draws.h"
#include "support/mapped_floor.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("lay maps") {
    TEST_CASE("the pieces of a sample tile it, and have its area") {
        Scene scene = wide_floor();
        const std::uint32_t other = add_material(scene, 0.4F);
        lay(scene,
            material_texels(square_frame(40, 28.0), {other},
                            [](int row, int column) {
                                return (row * column) % 3 == 0 ? std::uint16_t{0}
                                                               : MaterialTexels::own;
                            }),
            {});
        const Sonar sonar = imaging(ModelKind::paper);
        const Pose pose = sensor_pose(sonar, above_floor(), 0);
        for (const EngineKind type : engine_types) {
            const auto engine = make_engine(scene, {.type = type, .octree = {}});
            const Samples whole = engine->visible_surface(sonar.settings.view, pose);
            Samples cut = whole;
            apply_maps(*scene.maps, sonar.settings.view, pose, cut);
            CHECK(cut.items.size() > whole.items.size());
            const auto area = [](std::span<const Sample> samples) {
                double sum = 0.0;
                for (const Sample& sample : samples)
                    sum += static_cast<double>(sample.area_m2);
                return sum;
            };
            for (int j = 0; j < sonar.settings.view.beams; ++j) {
                CHECK(std::fabs(area(cut.beam(j)) - area(whole.beam(j))) <
                      1e-4 * area(whole.beam(j)));
            }
        }
    }

    TEST_CASE("a second surface has the strength of its texel") {
        // A wall ahead, whose echo over the floor doubles where the floor is twice as strong.
        Scene scene = wide_floor();
        add_quad(scene, {8, -9, 0}, {8, 9, 0}, {8, 9, 4}, {8, -9, 4}, 0, 4);
        Scene twice = scene;
        lay(twice, {}, strengths(square_frame(1, 28.0), [](int, int) { return 2.0F; }));
        for (const ModelKind model : {ModelKind::paper, ModelKind::calibrated}) {
            SonarConfig config = small_imaging();
            if (model == ModelKind::calibrated) config = bare_sonar(config, 900e3);
            config.multipath.method = MultipathMethod::cluster;
            const Sonar sonar = noise_free(config);
            const auto bounced = [&](const Scene& of) {
                const Pose pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5}};
                return expected_image(sonar, of, EngineKind::rays, pose, multipath_alone);
            };
            const std::vector<float> once = bounced(scene);
            const std::vector<float> both = bounced(twice);
            // One instance has floor and wall: both mirrors are twice as strong.
            int count = 0;
            for (std::size_t k = 0; k < once.size(); ++k) {
                if (once[k] == 0.0F) continue;
                CHECK(both[k] / once[k] == test::approx(4.0).epsilon(0.01));
                ++count;
            }
            CHECK(count > 20);
        }
    }

    TEST_CASE("speckle keeps the mean power of fields smaller than a scatterer's cell") {
        // All images have the same scatterers, so that their sums, over more than 1,000 cells a
        // ping, differ by less than speckle does.
        const SmallFields fields;
        SonarConfig config = imaging(ModelKind::calibrated).config;
        config.instrument.speckle.mode = SpeckleMode::scene;
        const Sonar sonar = make_sonar(config, {0.01});
        const auto sum_of = [&](const Scene& scene) {
            double sum = 0.0;
            for (const double yaw_deg : {0.0, 40.0, 80.0, 120.0}) {
                sum += total(expected_image(sonar, scene, EngineKind::strips, above_floor(yaw_deg),
                                            {.multipath = false}));
            }
            return sum;
        };
        const double expected = sum_of(fields.plain);
        CHECK(std::fabs(db(sum_of(fields.by_material) / expected)) < 0.15);
        CHECK(std::fabs(db(sum_of(fields.by_strength) / expected)) < 0.15);
    }
}
