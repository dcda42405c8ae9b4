// The example of docs/development.md, "Add a file format".
#include <spdlog/fmt/fmt.h>

#include "output/dataset/writer.h"
#include "support/small_mission.h"

namespace {

/// nearest/NNNNNN.csv: the range of the first bin with an echo in each beam, m.
std::string encode_nearest(const FinishedPing& finished) {
    std::string csv = "beam,range_m\n";
    for (int j = 0; j < finished.ping.beams; ++j) {
        int i = 0;
        while (i < finished.ping.range_bins && finished.ping.at(i, j) == 0.0F)
            ++i;
        if (i < finished.ping.range_bins)
            csv += fmt::format("{},{:.4f}\n", j, finished.sonar.range_edges_m[i]);
    }
    return csv;
}

Writer make_nearest_writer(const WriterContext&) {
    return {.per_ping = PingFile{"nearest", ".csv"}, .encode = encode_nearest};
}

}  // namespace

/// A wall across the boresight at x = 5 m, a beam at azimuth phi: its first echo is at 5 /
/// cos(phi), since the wall is nearest in the plane of the boresight.
TEST_CASE("example of a file format: the nearest echo of each beam") {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    mission.sensors[0].noise = {};
    mission.sensors[0].mount = {};
    Assembly assembly = small_assembly(mission, 1);
    assembly.scene = rectangle_scene({5, -9, -9}, {5, 9, 9}, 1.0F);
    const Sonar& sonar = assembly.sonars[0];
    const auto engine = make_engine(assembly.scene, {});
    const TracedPing traced = trace(sonar, assembly.scene, *engine, Pose{}, 0);
    const Ping ping = form_image(traced, sonar.settings, assembly.scene, {}, {});

    const Writer writer = make_nearest_writer({mission, assembly, 0, 1});
    const std::string csv = writer.encode({.id = {},
                                           .sonar = sonar,
                                           .traced = traced,
                                           .ping = ping,
                                           .measured = {},
                                           .clipped_pixels = 0});
    std::string expected = "beam,range_m\n";
    for (int j = 0; j < ping.beams; ++j) {
        const auto azimuth = [&](int edge) { return std::fabs(sonar.azimuth_edges_rad[edge]); };
        const double range = 5.0 / std::cos(std::min(azimuth(j), azimuth(j + 1)));
        const auto bin = std::ranges::upper_bound(sonar.range_edges_m, range) - 1;
        expected += fmt::format("{},{:.4f}\n", j, *bin);
    }
    CHECK(csv == expected);
}
