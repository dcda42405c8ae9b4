#include <cmath>

#include "core/units.h"
#include "hard/tools.h"
#include "support/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

/// The image of the original tank. If scene and sonar are moved or scaled together, it must not
/// change.
std::vector<float> at_home(const HardContext& context) {
    return image_of(tank(), in_tank(context.kind), context.engine, context.model);
}

constexpr double grazing_height_m = 1.745e-3;

/// A view along the floor: 0.01 degrees at 10 m.
HardTrial grazing(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, 0.0, 0.1), {0.31, 0.17, grazing_height_m}};
    return trial;
}

/// A sonar that looks forward has an echo of the floor in every bin. Sonars that look down have
/// none in range: within 85 degrees of nadir the floor is nearer than 1.745 mm / cos 85 = 20 mm.
std::vector<float> grazing_law(const HardContext& context) {
    if (!looks_forward(context.kind)) return dark(context);
    std::vector<float> truth(context.ping.intensity.size());
    const std::vector<double>& edges = context.trial.sonar.range_edges_m;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t i = k / static_cast<std::size_t>(context.ping.beams);
        truth[k] = static_cast<float>(0.5 * grazing_height_m / (0.5 * (edges[i] + edges[i + 1])));
    }
    return truth;
}

}  // namespace

std::vector<HardCase> hard_numbers() {
    return {{.name = "UTM, off the grid",
             .stresses = "512345.678, 4812345.678, -43.21 m",
             .scene = [] { return moved_tank(utm_odd); },
             .trial = [](SonarKind k) { return in_moved_tank(k, utm_odd); },
             .truth = at_home,
             .bounds = {1e-4, 1e-3},
             .truth_of_any_model = true},
            {.name = "a tank of a millimetre",
             .stresses = "8e-4 of its size, range 1 mm",
             .scene = [] { return scaled_tank(1.25e-4); },
             .trial = [](SonarKind k) { return in_scaled_tank(k, 1.25e-4); },
             .truth = at_home,
             .bounds = {1e-4}},
            {.name = "grazing incidence",
             .stresses = "down to 0.01 degrees",
             .scene = plain_floor,
             .trial = grazing,
             .truth = grazing_law,
             .bounds = {0.01}}};
}

}  // namespace sonarsim
