#include "survey/memory.h"

#include <algorithm>

#include "calibrated/model.h"

namespace sonarsim {

namespace {

// An estimate, not a measurement: surface in every bin, at the default error goal of 1 %.
constexpr double samples_per_bin = 4.0;
// An estimate too: the image, all labels and the encoded files.
constexpr double bytes_per_bin = 64.0;

/// Of the calibrated model: the grid of echoes, of which multipath has its own.
double grid_bytes(const Sonar& sonar) {
    if (!sonar.settings.calibrated) return 0.0;
    const auto columns = std::visit([](const auto& beams) { return columns_of(beams); },
                                    sonar.settings.calibrated->beams);
    const double grids = sonar.settings.multipath.on ? 2.0 : 1.0;
    return grids * columns * sonar.settings.view.range_bins * sizeof(float) * 2.0;
}

}  // namespace

PingMemory ping_memory(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const double bins = view.range_bins;
    const double seen_per_beam = bins * samples_per_bin * sizeof(Sample);
    const double image = view.beams * (seen_per_beam + bins * bytes_per_bin);
    const double beside = 2.0 * sonar.settings.beside.count * seen_per_beam;
    const double grid = grid_bytes(sonar);
    PingMemory out{.bytes = image + beside + grid, .key = "range_bins"};
    if (beside > std::max(image, grid))
        out.key = "instrument.beam.view_azimuth_deg";
    else if (image > grid && view.beams > view.range_bins)
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
        out.push_back(make_warning(Doubt::memory, about_sensor(sonar.config.name),
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
