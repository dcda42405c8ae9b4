#include "core/decibel.h"
#include "simulate/trace/apply_maps.h"
#include "support/calibrated.h"
#include "support/labelled.h"
#include "support/maps.h"
#include "support/patches.h"

namespace {

/// A floor of 30 x 30 m at z = 0.
Scene wide_floor() {
    return floor_scene(15.0F, 0.0F, 0.2F, 6);
}

/// The floor in fields of 2 cm, of materials of 0.1 and 0.3 or of strengths of 0.4 and 1.6, which
/// send back as much as the plain one of 0.2.
struct SmallFields {
    Scene plain = wide_floor();
    Scene by_material, by_strength;

    SmallFields() {
        const std::uint32_t dark = add_material(plain, 0.1F);
        const std::uint32_t bright = add_material(plain, 0.3F);
        for (Material& material : plain.materials) {
            material.slope_rms_deg = 0.0;
            material.lambert_db = db_of_power(static_cast<double>(material.reflection));
        }
        by_material = by_strength = plain;
        const TexelFrame frame = square_frame(1400, 28.0);
        const auto is_odd = [](int row, int column) { return (row + column) % 2 != 0; };
        lay(by_material, material_texels(frame, {dark, bright}, is_odd), {});
        lay(by_strength, {}, strengths(frame, [&](int row, int column) {
                return is_odd(row, column) ? 1.6F : 0.4F;
            }));
    }
};

/// 3 m above the floor and not over a border, heading off the axes.
Pose above_floor(double yaw_deg = 20.0) {
    return {rotation_from_rpy(0.0, 0.0, radians(yaw_deg)), {0.3, -0.4, 3.0}};
}

Sonar imaging(ModelKind model, int bins = 80) {
    SonarConfig config = small_imaging();
    if (model == ModelKind::calibrated) config = bare_sonar(config, 900e3);
    config.noise.gain = 1.0;
    config.elevation_deg = 40.0;
    set_range(config, 4.0, 12.0, bins);
    config.azimuth_bins = 32;
    config.mount.rpy_deg = {0.0, 30.0, 0.0};
    return make_sonar(config, {0.01});
}

Sonar sidescan(ModelKind model, double bin_m = 0.05) {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    if (model == ModelKind::calibrated) config = bare_sonar(config, 400e3);
    config.noise.gain = 1.0;
    set_range(config, 3.5, 12.5, static_cast<int>(std::lround(9.0 / bin_m)));
    return make_sonar(config, {0.01});
}

constexpr double six_db = 3.9810717055349722;  // 10^0.6

/// Fields of `field_m`, 6 dB apart.
StrengthTexels chequered(double field_m) {
    const int n = static_cast<int>(std::lround(28.0 / field_m));
    return strengths(square_frame(n, n * field_m), [](int row, int column) {
        return (row + column) % 2 == 0 ? 1.0F : static_cast<float>(six_db);
    });
}

/// The factors of points of the floor by bin, [range bins, beams].
struct FactorsOfBins {
    Eigen::ArrayXXd sum, weight, min, max;
};

/// Points of a lattice on the floor ahead of the vehicle, or abeam, each in the bin it lies in.
FactorsOfBins factors_of_bins(const Sonar& sonar, const Scene& scene, const Pose& vehicle,
                              bool side) {
    const View& view = sonar.settings.view;
    const Pose pose = sensor_pose(sonar, vehicle, 0);
    const Eigen::Matrix3d to_sensor = pose.rotation.toRotationMatrix().transpose();
    const Eigen::ArrayXXd none = Eigen::ArrayXXd::Zero(view.range_bins, view.beams);
    FactorsOfBins out{none, none, none + 1e9, none};
    const Eigen::Vector2d low = side ? Eigen::Vector2d(-0.1, -12.5) : Eigen::Vector2d(2.0, -6.5);
    const Eigen::Vector2d high = side ? Eigen::Vector2d(0.1, 12.5) : Eigen::Vector2d(12.0, 6.5);
    const Eigen::Vector2d step = side ? Eigen::Vector2d(0.002, 0.005) : Eigen::Vector2d(0.01, 0.01);
    const Eigen::Array2i count = ((high - low).array() / step.array()).round().cast<int>();
    for (int i = 0; i < count.x(); ++i) {
        for (int j = 0; j < count.y(); ++j) {
            const Eigen::Vector2d own = low + Eigen::Vector2d(i + 0.5, j + 0.5).cwiseProduct(step);
            Eigen::Vector3d world =
                vehicle.rotation * Eigen::Vector3d(own.x(), own.y(), 0.0) + vehicle.translation;
            world.z() = 0.0;
            const Eigen::Vector3f p = (to_sensor * (world - pose.translation)).cast<float>();
            const double range = static_cast<double>(p.norm());
            const int bin = static_cast<int>(std::floor((range - view.range_min_m) / view.bin_m()));
            const int beam = beam_of(view, p);
            if (bin < 0 || bin >= view.range_bins || beam < 0) continue;
            const double factor = scene.maps->at(0, 0, world.head<2>()).strength;
            const double cosine = pose.translation.z() / range;
            out.sum(bin, beam) += factor * cosine;
            out.weight(bin, beam) += cosine;
            out.min(bin, beam) = std::min(out.min(bin, beam), factor);
            out.max(bin, beam) = std::max(out.max(bin, beam), factor);
        }
    }
    return out;
}

/// The factor of the bins around a bin, if it is one; 0 at borders.
double factor_around(const FactorsOfBins& factors, int bin, int beam, int bins, int beams) {
    if (bin < bins || bin + bins >= factors.weight.rows()) return 0.0;
    if (beam < beams || beam + beams >= factors.weight.cols()) return 0.0;
    const auto around = [&](const Eigen::ArrayXXd& of) {
        return of.block(bin - bins, beam - beams, 2 * bins + 1, 2 * beams + 1);
    };
    const double factor = around(factors.min).minCoeff();
    const bool is_one = factor == around(factors.max).maxCoeff();
    return is_one && (around(factors.weight) > 0.0).all() ? factor : 0.0;
}

}  // namespace

TEST_CASE("the paper's images have the mean over every bin: a chequered map of 6 dB") {
    // Fields of 1.4 m, 14 bins and more, and fields of 0.25 m.
    for (const double field_m : {1.4, 0.25}) {
        for (const bool side : {false, true}) {
            const Sonar sonar = side ? sidescan(ModelKind::paper, 0.1) : imaging(ModelKind::paper);
            const View& view = sonar.settings.view;
            const Scene plain = wide_floor();
            Scene scene = plain;
            lay(scene, {}, chequered(field_m));
            const Pose pose = above_floor();
            const FactorsOfBins expected = factors_of_bins(sonar, scene, pose, side);
            for (const EngineKind type : engine_types) {
                if (field_m < 1.0 && type != EngineKind::strips) continue;
                CAPTURE_ALL(field_m, side, static_cast<int>(type));
                const auto image_of = [&](const Scene& of) -> Eigen::ArrayXXd {
                    return image_array(expected_image(sonar, of, type, pose), view.beams)
                        .cast<double>();
                };
                const Eigen::ArrayXXd without = image_of(plain);
                // Bins at the rim of the view hold few points.
                const auto counts = (expected.weight >= 60.0 && without != 0.0).eval();
                const Eigen::ArrayXXd found = counts.select(image_of(scene) / without, 0.0);
                const Eigen::ArrayXXd mean = counts.select(expected.sum / expected.weight, 0.0);
                CHECK(counts.count() > (side ? 150 : 2000));
                CHECK((found - mean).abs().sum() < (field_m > 1.0 ? 0.01 : 0.05) * mean.sum());
                // A bin with a border has the mean over its area. Rays alone are off by more.
                const auto at_border = (counts && expected.min != expected.max).eval();
                CHECK(at_border.count() >= 20);
                if (type == EngineKind::strips) {
                    const Eigen::ArrayXXd off_db =
                        at_border.select(10.0 * (found / mean).log10(), 0.0);
                    CHECK(off_db.square().sum() < 0.1 * 0.1 * at_border.count());
                    CHECK(off_db.abs().maxCoeff() < 0.6);
                }
            }
        }
    }
}

TEST_CASE("a chequered map of 6 dB makes scatterers 6 dB stronger") {
    // Scatterers and their phases are those of the scene without the map, so the powers of a
    // field change by the factor, except for what its neighbours send into its side lobes.
    for (const bool side : {false, true}) {
        SonarConfig config =
            side ? sidescan(ModelKind::calibrated).config : imaging(ModelKind::calibrated).config;
        config.instrument.speckle.mode = SpeckleMode::scene;
        config.instrument.speckle.texture = 0.0;
        const Sonar sonar = make_sonar(config, {0.01});
        const View& view = sonar.settings.view;
        const Scene plain = wide_floor();
        Scene scene = plain;
        lay(scene, {}, chequered(2.8));
        const Pose pose = above_floor(side ? 0.0 : 20.0);
        const FactorsOfBins factors = factors_of_bins(sonar, scene, pose, side);
        // The sums over the fields of either factor.
        const auto sums_of = [&](const Scene& of) {
            const std::vector<float> image = expected_image(sonar, of, EngineKind::rays, pose,
                                                            {.multipath = false, .random = 1});
            std::array<double, 2> sums{};
            for (int i = 0; i < view.range_bins; ++i) {
                for (int j = 0; j < view.beams; ++j) {
                    const double factor = factor_around(factors, i, j, 3, side ? 0 : 2);
                    const std::size_t k = static_cast<std::size_t>(i) * view.beams + j;
                    if (factor > 0.0) sums[factor > 1.0 ? 1 : 0] += image[k];
                }
            }
            return sums;
        };
        const std::array<double, 2> with = sums_of(scene);
        const std::array<double, 2> without = sums_of(plain);
        CAPTURE(side);
        CHECK(std::fabs(db_of_power(with[0] / without[0])) < 0.2);
        CHECK(std::fabs(db_of_power(with[1] / without[1] / six_db)) < 0.2);
    }
}

TEST_CASE("fields smaller than a bin count by their area") {
    const SmallFields fields;
    for (const ModelKind model : {ModelKind::paper, ModelKind::calibrated}) {
        for (const bool side : {false, true}) {
            const Sonar sonar = side ? sidescan(model, 0.2) : imaging(model, 40);
            const View& view = sonar.settings.view;
            const auto rows = [&](const Scene& scene) -> Eigen::ArrayXXd {
                // Without the rim of the view, whose bins are not full.
                const int rim = side ? 0 : 3;
                return image_array(expected_image(sonar, scene, EngineKind::strips, above_floor()),
                                   view.beams)
                    .block(5, rim, view.range_bins - 10, view.beams - 2 * rim)
                    .cast<double>();
            };
            const Eigen::ArrayXXd without = rows(fields.plain);
            CHECK(without.size() > (side ? 60 : 700));
            for (const Scene* const scene : {&fields.by_strength, &fields.by_material}) {
                CAPTURE_ALL(static_cast<int>(model), side, scene == &fields.by_strength);
                const Eigen::ArrayXXd off_db = 10.0 * (rows(*scene) / without).log10();
                CHECK(std::fabs(off_db.mean()) < 0.05);
                // A pulse sees less than a bin, and so fewer fields.
                CHECK(off_db.abs().maxCoeff() < (model == ModelKind::paper ? 0.2 : 0.5));
            }
        }
    }
}

TEST_CASE("the pieces of a sample tile it, and have its area") {
    Scene scene = wide_floor();
    const std::uint32_t other = add_material(scene, 0.4F);
    lay(scene,
        material_texels(square_frame(40, 28.0), {other},
                        [](int row, int column) {
                            return (row * column) % 3 == 0 ? std::uint16_t{0} : MaterialTexels::own;
                        }),
        {});
    const Sonar sonar = imaging(ModelKind::paper);
    const Pose pose = sensor_pose(sonar, above_floor(), 0);
    for (const EngineKind type : engine_types) {
        const Samples whole = engine_of(scene, type)->visible_surface(sonar.settings.view, pose);
        Samples cut = whole;
        apply_maps(*scene.maps, sonar.settings.view, pose, cut);
        CHECK(cut.items.size() > whole.items.size());
        for (int j = 0; j < sonar.settings.view.beams; ++j) {
            const double area = area_of(whole.beam(j));
            CHECK(std::fabs(area_of(cut.beam(j)) - area) < 1e-4 * area);
        }
    }
}

TEST_CASE("a second surface has the strength of its texel") {
    // A wall ahead, whose echo over the floor doubles where the floor is twice as strong.
    Scene scene = wide_floor();
    add_rectangle(scene, {8, -9, 0}, {8, 9, 4}, 0, 4);
    Scene twice = scene;
    lay(twice, {}, strengths(square_frame(1, 28.0), [](int, int) { return 2.0F; }));
    for (const ModelKind model : {ModelKind::paper, ModelKind::calibrated}) {
        SonarConfig config = small_imaging();
        if (model == ModelKind::calibrated) config = bare_sonar(config, 900e3);
        config.multipath.method = MultipathMethod::cluster;
        const Sonar sonar = noise_free(config);
        const auto bounced = [&](const Scene& of) {
            return expected_image(sonar, of, EngineKind::rays, {.translation = {0.0, 0.0, 0.5}},
                                  multipath_alone);
        };
        const std::vector<float> once = bounced(scene);
        const std::vector<float> both = bounced(twice);
        // One instance has floor and wall: both mirrors are twice as strong.
        int count = 0;
        for (std::size_t k = 0; k < once.size(); ++k) {
            if (once[k] == 0.0F) continue;
            CHECK(both[k] / once[k] == approx(4.0).epsilon(0.01));
            ++count;
        }
        CHECK(count > 20);
    }
}

TEST_CASE("speckle keeps the mean power of fields smaller than a scatterer's cell") {
    // All images have the same scatterers: sums over 1,000 cells differ by less than speckle.
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
    CHECK(std::fabs(db_of_power(sum_of(fields.by_material) / expected)) < 0.15);
    CHECK(std::fabs(db_of_power(sum_of(fields.by_strength) / expected)) < 0.15);
}
