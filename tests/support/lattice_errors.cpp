#include "support/lattice_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "support/slivers.h"
#include "validation/image_error.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/make_engine.h"
#include "visibility/slices/edge_rays.h"
#include "visibility/slices/sampled_image.h"

namespace sonarsim::test {

namespace {

/// Accepts the image in bins that the reference lacks and in which rays to its samples end: such a
/// ray proves that the bin has surface. Slivers before a border, or seen through gaps, get smaller
/// than any number of rays to random points can find.
void accept_proved_bins(const Lattice& lattice, const VisibilityEngine& engine, double goal,
                        const std::vector<float>& image, Reference& reference) {
    const View view = make_sonar(lattice.sonar, {goal}).settings.view;
    Samples samples = engine.visible_surface(view, Pose{});
    const std::vector<EdgeBin> edges =
        settle_edge_bins(Caster(lattice.scene), view, local_pose(Pose{}, lattice.scene.origin),
                         image_of(lattice.scene, view, samples), samples);
    for (int bin = 0; bin < view.range_bins; ++bin) {
        for (int beam = 0; beam < view.beams; ++beam) {
            const std::size_t k = static_cast<std::size_t>(bin) * view.beams + beam;
            const std::size_t by_beam = static_cast<std::size_t>(beam) * view.range_bins + bin;
            if (!(reference.intensity[k] > 0.0F) && edges[by_beam] == EdgeBin::filled)
                reference.intensity[k] = image[k];
        }
    }
}

}  // namespace

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
        Reference known = reference;
        add_slivers(lattice.scene, make_sonar(lattice.sonar, {}).settings.view, ping.intensity,
                    known);
        accept_proved_bins(lattice, *made, goal, ping.intensity, known);
        errors.push_back({lattice.sonar.kind, lattice.shape, number, goal,
                          image_error(ping.intensity, known.intensity).relative_l1, reference.apart,
                          ping.estimated_l1});
    }
    return errors;
}

std::string lattice_table(const std::vector<LatticeError>& errors) {
    struct Row {
        int pings = 0;
        int missed = 0;
        int silent = 0;
        int vain = 0;
        double worst = 0.0;
    };
    std::map<std::pair<double, std::string>, Row, std::greater<>> rows;
    for (const LatticeError& e : errors) {
        for (const std::string& kind : {std::string(name_of(e.kind)), std::string("all")}) {
            Row& row = rows[{e.goal, kind}];
            ++row.pings;
            row.missed += e.error - e.reference > e.goal;
            row.silent += e.missed_in_silence();
            row.vain += e.warned_in_vain();
            if (e.missed_in_silence()) row.worst = std::max(row.worst, e.error / e.goal);
        }
    }
    std::string text =
        "| goal | sonar | pings | over the goal | missed in silence | worst ratio | warned in vain "
        "|\n|---|---|---|---|---|---|---|\n";
    for (const auto& [key, row] : rows) {
        const auto share = [&, pings = row.pings](int count) -> std::string {
            return fmt::format("{:.1f} %", 100.0 * count / pings);
        };
        text +=
            fmt::format("| {:.0f} % | {} | {} | {} | {} | {} | {} |\n", 100.0 * key.first,
                        key.second, row.pings, share(row.missed), share(row.silent),
                        row.silent > 0 ? fmt::format("{:.2f}", row.worst) : "", share(row.vain));
    }
    return text;
}

}  // namespace sonarsim::test
