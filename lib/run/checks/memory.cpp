#include <algorithm>

#include "run/checks/find_warnings.h"

namespace sonarsim {

namespace {

// An estimate, not a measurement: surface in every bin, at an error goal of 1 %.
constexpr double samples_per_bin = 4.0;
// Also an estimate: the image, all labels and the encoded files.
constexpr double bytes_per_bin = 64.0;

}  // namespace

PingMemory ping_memory(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const double bins = view.range_bins;
    const double visible_per_beam = bins * samples_per_bin * sizeof(Sample);
    const double image = view.beams * (visible_per_beam + bins * bytes_per_bin);
    const double guards = 2.0 * view.guards.count * visible_per_beam;
    const EchoModelInfo& model = sonar.settings.model->info;
    const double working =
        model.working_bytes + (sonar.settings.multipath.on ? model.multipath_bytes : 0.0);
    PingMemory out{.bytes = image + guards + working, .key = "range_bins"};
    if (guards > std::max(image, working))
        out.key = "instrument.beam.view_azimuth_deg";
    else if (image > working && view.beams > view.range_bins)
        out.key = "azimuth_bins";
    return out;
}

std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available) {
    constexpr double giga = 1e9;
    std::vector<Warning> out;
    for (const Sonar& sonar : sonars) {
        const PingMemory ping = ping_memory(sonar);
        if (threads * ping.bytes <= available) continue;
        out.push_back(make_warning(WarningCode::memory, about_sensor(sonar.config.name),
                                   ping.bytes / giga, threads, threads * ping.bytes / giga,
                                   available / giga, ping.key));
    }
    return out;
}

bool exceeds_memory(const std::vector<Sonar>& sonars, double available) {
    return std::ranges::any_of(
        sonars, [&](const Sonar& sonar) { return ping_memory(sonar).bytes > available; });
}

}  // namespace sonarsim
