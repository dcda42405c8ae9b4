#include "support/lattice_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "validation/image_error.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/make_engine.h"

namespace sonarsim::test {

Ping render_lattice(const Lattice& lattice, const VisibilityEngine& engine, double goal) {
    SonarConfig config = lattice.sonar;
    config.noise.gain = 1.0;
    Sonar sonar = make_sonar(config, {goal});
    sonar.T_vehicle_sensor = Pose{};
    return render_ping(sonar, lattice.scene, engine, Pose{}, {.seed = 1, .ping = 0},
                       direct_echoes_alone);
}

Reference lattice_reference(const Lattice& lattice, std::uint64_t rays) {
    const View view = make_sonar(lattice.sonar, {}).settings.view;
    return cast_reference(Caster(lattice.scene), lattice.scene, view, Pose{}, {0.0005, 16.0, rays});
}

std::vector<LatticeError> lattice_errors(std::uint32_t number, const Lattice& lattice,
                                         const Reference& reference, EngineKind engine,
                                         const std::vector<double>& goals) {
    // A single bin decides about images of few bins.
    constexpr std::ptrdiff_t fewest_bins = 16;
    if (std::ranges::count_if(reference.intensity, [](float x) { return x > 0.0F; }) < fewest_bins)
        return {};
    std::vector<LatticeError> errors;
    for (const double goal : goals) {
        const auto made = make_engine(lattice.scene, {.type = engine, .octree = {}});
        const Ping ping = render_lattice(lattice, *made, goal);
        errors.push_back({lattice.sonar.kind, lattice.shape, number, goal,
                          image_error(ping.intensity, reference.intensity, reference.scored)
                              .relative_l1,
                          reference.apart});
    }
    return errors;
}

std::string lattice_table(const std::vector<LatticeError>& errors) {
    struct Row {
        int pings = 0;
        int missed = 0;
        double worst = 0.0;
    };
    std::map<std::pair<double, std::string>, Row, std::greater<>> rows;
    for (const LatticeError& e : errors) {
        for (const std::string& kind : {std::string(name_of(e.kind)), std::string("all")}) {
            Row& row = rows[{e.goal, kind}];
            ++row.pings;
            row.missed += e.error - e.reference > e.goal;
            row.worst = std::max(row.worst, e.error / e.goal);
        }
    }
    std::string text =
        "| goal | sonar | pings | over the goal | worst ratio |\n|---|---|---|---|---|\n";
    for (const auto& [key, row] : rows) {
        const auto share = [&, pings = row.pings](int count) -> std::string {
            return fmt::format("{:.1f} %", 100.0 * count / pings);
        };
        text += fmt::format("| {:.0f} % | {} | {} | {} | {:.2f} |\n", 100.0 * key.first, key.second,
                            row.pings, share(row.missed), row.worst);
    }
    return text;
}

}  // namespace sonarsim::test
