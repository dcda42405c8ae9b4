#include <algorithm>

#include "core/units.h"
#include "sonar/kinds.h"
#include "hard/tools.h"
#include "support/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

/// A sonar of the tank with a gain of 1. Side-scan has no range noise.
std::function<HardTrial(SonarKind)> tank_with(const NoiseConfig& noise) {
    return [noise](SonarKind kind) {
        return in_tank(kind, [&](SonarConfig& c) {
            c.noise = noise;
            if (kind == SonarKind::sidescan) c.noise.range_lambda_m = 0.0;
        });
    };
}

NoiseConfig range_noise(double lambda_m) {
    NoiseConfig noise;
    noise.range_lambda_m = lambda_m;
    return noise;
}

NoiseConfig pixel_noise(double sigma) {
    NoiseConfig noise;
    noise.add_sigma = noise.mult_sigma = sigma;
    return noise;
}

/// The image without range noise, for kinds whose range noise does not weaken echoes; others are
/// not checked.
std::vector<float> without_noise_where_nothing_fades(const HardContext& context) {
    if (kind_of(context.kind).range_noise_fades)
        return std::vector<float>(context.ping.intensity.size(), unchecked);
    return image_of(context.scene, in_tank(context.kind), context.engine, context.model);
}

/// P(w < 10 m) = 1e-8 at lambda = 1e9 m: sonars with range noise receive no echo in range.
std::vector<float> all_drowned(const HardContext& context) {
    return context.kind == SonarKind::sidescan
               ? std::vector<float>(context.ping.intensity.size(), unchecked)
               : dark(context);
}

std::function<HardTrial(SonarKind)> with_streaks(StreakMode mode) {
    return [mode](SonarKind kind) {
        return in_tank(kind, [&](SonarConfig& c) {
            c.streaks = {mode, 0.0, 90.0};  // every row with an echo
            c.noise.add_sigma = 5.0;
            c.noise.scale_with_range = false;
        });
    };
}

/// With threshold 0 all rows with an echo become 1 - (1 - I)^2 or I^2 of a clamped I, which is
/// within [0, 1] however bright the noise is. Only pixels above 1 count as errors here.
std::vector<float> at_most_one(const HardContext& context) {
    std::vector<float> truth(context.ping.intensity.size(), unchecked);
    const std::vector<float> clean =
        image_of(context.scene, in_tank(context.kind), context.engine, context.model);
    const auto beams = static_cast<std::size_t>(context.ping.beams);
    for (std::size_t row = 0; row < truth.size(); row += beams) {
        bool occupied = false;
        for (std::size_t k = row; k < row + beams; ++k)
            occupied = occupied || clean[k] > 0.0F;
        for (std::size_t k = row; occupied && k < row + beams; ++k)
            truth[k] = std::min(context.ping.intensity[k], 1.0F);
    }
    return truth;
}

/// A wall along the boresight, so near that specular reflections from the floor run along the wall.
Scene wall_along() {
    Scene scene = plain_floor();
    add_quad(scene, {-9, 0.4F, 0}, {20, 0.4F, 0}, {20, 0.4F, 6}, {-9, 0.4F, 6}, 0);
    return scene;
}

void clusters(SonarConfig& config) {
    config.multipath.method = MultipathMethod::cluster;
}

/// The multipath of the original tank. If scene and sonar are moved or scaled together, the image
/// must not change.
std::vector<float> multipath_in_unmoved_tank(const HardContext& context) {
    return image_of(tank(), in_tank(context.kind, clusters), context.engine, context.model);
}

HardTrial multipath_along(SonarKind kind) {
    HardTrial trial = over_floor(kind, clusters);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, looks_forward(kind) ? radians(30.0) : 0.0, 0.0),
                             {0.0, 0.39, 3.0}};
    return trial;
}

}  // namespace

std::vector<HardCase> hard_noise() {
    return {{.name = "lambda 1e-9 m",
             .stresses = "range noise below any float's step",
             .expected = "unchanged where nothing fades",
             .scene = tank,
             .trial = tank_with(range_noise(1e-9)),
             .truth = without_noise_where_nothing_fades,
             .bounds = {0.02}},
            {.name = "lambda 100 m",
             .stresses = "range noise of ten times the range",
             .expected = "invariants",
             .scene = tank,
             .trial = tank_with(range_noise(100.0))},
            {.name = "lambda 1e9 m",
             .stresses = "all echoes drowned",
             .expected = "dark; P(w < 10 m) = 1e-8",
             .scene = tank,
             .trial = tank_with(range_noise(1e9)),
             .truth = all_drowned,
             .bounds = {0}},
            {.name = "sigma 0",
             .stresses = "no pixel noise",
             .expected = "the image without it",
             .scene = tank,
             .trial = tank_with(pixel_noise(0.0)),
             .truth =
                 [](const HardContext& context) {
                     return image_of(context.scene, in_tank(context.kind), context.engine,
                                     context.model);
                 },
             .bounds = {0}},
            {.name = "sigma 1e9",
             .stresses = "pixel noise as large as a mission allows",
             .expected = "invariants",
             .scene = tank,
             .trial = tank_with(pixel_noise(1e9)),
             .noisy = true},
            {.name = "streaks added above 1",
             .stresses = "1 - (1 - I)^2 turns around there",
             .expected = "rows within [0, 1]",
             .scene = tank,
             .trial = with_streaks(StreakMode::add),
             .truth = at_most_one,
             .bounds = {0},
             .noisy = true},
            {.name = "streaks reduced above 1",
             .stresses = "I^2 grows there",
             .expected = "rows within [0, 1]",
             .scene = tank,
             .trial = with_streaks(StreakMode::reduce),
             .truth = at_most_one,
             .bounds = {0},
             .noisy = true},
            {.name = "multipath edge-on",
             .stresses = "[2] divides by r . n of a wall alongside",
             .expected = "invariants",
             .scene = wall_along,
             .trial = multipath_along},
            {.name = "multipath on a surface",
             .stresses = "sources without a direction",
             .expected = "invariants",
             .scene = wall_along,
             .trial =
                 [](SonarKind kind) {
                     HardTrial trial = multipath_along(kind);
                     trial.T_world_vehicle.translation.z() = 0.0;
                     return trial;
                 }},
            {.name = "multipath, far from the origin",
             .stresses = "512345.678, 4812345.678, -43.21 m",
             .expected = "the image at the origin",
             .scene = [] { return moved_tank(utm_odd); },
             .trial = [](SonarKind k) { return in_moved_tank(k, utm_odd, clusters); },
             .truth = multipath_in_unmoved_tank,
             .bounds = {1e-4, 1e-3}},
            {.name = "multipath in a millimetre",
             .stresses = "is p hidden? in a tank 8e-4 of its size",
             .expected = "the image in full size",
             .scene = [] { return scaled_tank(1.25e-4); },
             .trial = [](SonarKind k) { return in_scaled_tank(k, 1.25e-4, clusters); },
             .truth = multipath_in_unmoved_tank,
             .bounds = {1e-4}},
            {.name = "multipath in 50 km",
             .stresses = "is p hidden? in a tank 6250 times its size",
             .expected = "the image in full size",
             .scene = [] { return scaled_tank(6250.0); },
             .trial = [](SonarKind k) { return in_scaled_tank(k, 6250.0, clusters); },
             .truth = multipath_in_unmoved_tank,
             .bounds = {1e-4}}};
}

}  // namespace sonarsim
