#include <algorithm>

#include "core/units.h"
#include "validation/hard/tools.h"
#include "validation/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

/// A sonar of the tank with its gain of 1. Side-scan has no range noise.
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

/// Where range noise moves nothing and fades nothing: the image without it.
std::vector<float> without_noise_where_nothing_fades(const HardLook& look) {
    const bool fades = look.kind == SonarKind::imaging || look.kind == SonarKind::profiling;
    if (fades) return std::vector<float>(look.ping.intensity.size(), ignored);
    return image_of(look.scene, in_tank(look.kind), look.engine);
}

/// P(w < 10 m) = 1e-8 at lambda = 1e9 m: what has range noise sees nothing.
std::vector<float> all_drowned(const HardLook& look) {
    return look.kind == SonarKind::sidescan
               ? std::vector<float>(look.ping.intensity.size(), ignored)
               : dark(look);
}

std::function<HardTrial(SonarKind)> with_streaks(StreakMode mode) {
    return [mode](SonarKind kind) {
        return in_tank(kind, [&](SonarConfig& c) {
            c.streaks = {mode, 0.0, 90.0};  // every row that sees anything
            c.noise.add_sigma = 5.0;
            c.noise.scale_with_range = false;
        });
    };
}

/// With threshold 0 all rows that see surface become 1 - (1 - I)^2 or I^2 of a clamped I: within
/// [0, 1] however bright the noise is. Here only what is above 1 counts as an error.
std::vector<float> at_most_one(const HardLook& look) {
    std::vector<float> truth(look.ping.intensity.size(), ignored);
    const std::vector<float> clean = image_of(look.scene, in_tank(look.kind), look.engine);
    const auto beams = static_cast<std::size_t>(look.ping.beams);
    for (std::size_t row = 0; row < truth.size(); row += beams) {
        bool lit = false;
        for (std::size_t k = row; k < row + beams; ++k)
            lit = lit || clean[k] > 0.0F;
        for (std::size_t k = row; lit && k < row + beams; ++k)
            truth[k] = std::min(look.ping.intensity[k], 1.0F);
    }
    return truth;
}

/// A wall along the boresight, so near to it that what the floor mirrors runs along the wall.
Scene wall_along() {
    Scene scene = plain_floor();
    add_quad(scene, {-9, 0.4F, 0}, {20, 0.4F, 0}, {20, 0.4F, 6}, {-9, 0.4F, 6}, 0);
    return scene;
}

void clusters(SonarConfig& config) {
    config.multipath.method = MultipathMethod::cluster;
}

/// What multipath there is in the tank at home: neither a motion nor a scale can be told from it.
std::vector<float> multipath_at_home(const HardLook& look) {
    return image_of(tank(), in_tank(look.kind, clusters), look.engine);
}

HardTrial multipath_along(SonarKind kind) {
    HardTrial trial = over_floor(kind, clusters);
    trial.T_world_vehicle = {
        rotation_from_rpy(0.0, kind == SonarKind::imaging ? radians(30.0) : 0.0, 0.0),
        {0.0, 0.39, 3.0}};
    return trial;
}

}  // namespace

std::vector<HardCase> hard_noise() {
    return {
        {"lambda 1e-9 m",
         "range noise below any float's step",
         "unchanged where nothing fades",
         tank,
         tank_with(range_noise(1e-9)),
         without_noise_where_nothing_fades,
         {0.02, 0.02}},
        {"lambda 100 m",
         "range noise of ten times the range",
         "invariants",
         tank,
         tank_with(range_noise(100.0)),
         {},
         {}},
        {"lambda 1e9 m",
         "all echoes drowned",
         "dark; P(w < 10 m) = 1e-8",
         tank,
         tank_with(range_noise(1e9)),
         all_drowned,
         {0, 0}},
        {"sigma 0",
         "no pixel noise",
         "the image without it",
         tank,
         tank_with(pixel_noise(0.0)),
         [](const HardLook& look) { return image_of(look.scene, in_tank(look.kind), look.engine); },
         {0, 0}},
        {"sigma 1e9",
         "pixel noise as large as a mission allows",
         "invariants",
         tank,
         tank_with(pixel_noise(1e9)),
         {},
         {},
         true},
        {"streaks added above 1",
         "1 - (1 - I)^2 turns around there",
         "rows within [0, 1]",
         tank,
         with_streaks(StreakMode::add),
         at_most_one,
         {0, 0},
         true},
        {"streaks reduced above 1",
         "I^2 grows there",
         "rows within [0, 1]",
         tank,
         with_streaks(StreakMode::reduce),
         at_most_one,
         {0, 0},
         true},
        {"multipath edge-on",
         "[2] divides by r . n of a wall alongside",
         "invariants",
         wall_along,
         multipath_along,
         {},
         {}},
        {"multipath on a surface",
         "sources without a direction",
         "invariants",
         wall_along,
         [](SonarKind kind) {
             HardTrial trial = multipath_along(kind);
             trial.T_world_vehicle.translation.z() = 0.0;
             return trial;
         },
         {},
         {}},
        {"multipath, far from the origin",
         "512345.678, 4812345.678, -43.21 m",
         "the image at the origin",
         [] { return moved_tank(utm_odd); },
         [](SonarKind k) { return in_moved_tank(k, utm_odd, clusters); },
         multipath_at_home,
         {1e-4, 1e-4}},
        {"multipath in a millimetre",
         "is p hidden? in a tank 8e-4 of its size",
         "the image in full size",
         [] { return scaled_tank(1.25e-4); },
         [](SonarKind k) { return in_scaled_tank(k, 1.25e-4, clusters); },
         multipath_at_home,
         {1e-4, 1e-4}},
        {"multipath in 50 km",
         "is p hidden? in a tank 6250 times its size",
         "the image in full size",
         [] { return scaled_tank(6250.0); },
         [](SonarKind k) { return in_scaled_tank(k, 6250.0, clusters); },
         multipath_at_home,
         {1e-4, 0.25}},
    };
}

}  // namespace sonarsim
