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
            std::vector<Sample> none;
            apply_maps(*scene.maps, sonar.settings.view, pose, cut, none);
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
            if (model == ModelKind::calibrated) {
                config = calibrated(config, 900e3);
                config.instrument = bare(config.instrument);
                config.instrument.speckle.mode = SpeckleMode::none;
            }
            config.multipath.method = MultipathMethod::cluster;
            const Sonar sonar = noise_free(config);
            const auto bounced = [&](const Scene& of) {
                const auto engine = make_engine(of, {.type = EngineKind::rays, .octree = {}});
                const Pose pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5}};
                return render_ping(sonar, of, *engine, pose, {.seed = 1, .ping = 0},
                                   multipath_alone)
                    .intensity;
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
        // Materials of 0.1 and 0.3 in fields of 2 cm, or strengths of 0.5 and 1.5, send back as
        // much as one of 0.2. Both images have the same scatterers, so that their sums, over more
        // than 1,000 cells a ping, differ by less than speckle does.
        Scene plain = wide_floor();
        const std::uint32_t dark = add_material(plain, 0.1F);
        const std::uint32_t bright = add_material(plain, 0.3F);
        for (Material& material : plain.materials) {
            material.slope_rms_deg = 0.0;
            material.lambert_db = db(static_cast<double>(material.reflection));
        }
        const auto field = [](int row, int column) {
            return static_cast<std::uint16_t>((row + column) % 2);
        };
        Scene by_material = plain;
        lay(by_material, material_texels(square_frame(1400, 28.0), {dark, bright}, field), {});
        Scene by_strength = plain;
        lay(by_strength, {}, strengths(square_frame(1400, 28.0), [&](int row, int column) {
                return 0.5F + static_cast<float>(field(row, column));
            }));
        SonarConfig config = imaging(ModelKind::calibrated).config;
        config.instrument.speckle.mode = SpeckleMode::scene;
        const Sonar sonar = make_sonar(config, {0.01});
        const auto sum_of = [&](const Scene& scene) {
            const auto engine = make_engine(scene, {.type = EngineKind::slices, .octree = {}});
            double sum = 0.0;
            for (const double yaw_deg : {0.0, 40.0, 80.0, 120.0}) {
                sum += total(render_ping(sonar, scene, *engine, above_floor(yaw_deg),
                                         {.seed = 1, .ping = 0}, {.multipath = false})
                                 .intensity);
            }
            return sum;
        };
        const double expected = sum_of(plain);
        CHECK(std::fabs(db(sum_of(by_material) / expected)) < 0.15);
        CHECK(std::fabs(db(sum_of(by_strength) / expected)) < 0.15);
    }
}
