#include "simulate/product/scan.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "core/units.h"

namespace sonarsim {

int scan_steps(const SonarConfig& config) {
    return std::max(1, static_cast<int>(std::floor(config.sector_deg / config.step_deg + 0.5)));
}

std::string scan_file_name(const std::string& stem, std::size_t sweep,
                           const std::string& extension) {
    return fmt::format("{}_{:04}{}", stem, sweep, extension);
}

int scan_step(const SonarConfig& config, std::size_t ping) {
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    const bool back = config.sector_deg < 360.0 && (ping / steps) % 2 == 1;
    const auto step = static_cast<int>(ping % steps);
    return back ? static_cast<int>(steps) - 1 - step : step;
}

std::vector<double> scan_edges_rad(const SonarConfig& config) {
    const int steps = scan_steps(config);
    std::vector<double> edges(steps + 1);
    for (int i = 0; i <= steps; ++i)
        edges[i] = radians(config.sector_deg) * (static_cast<double>(i) / steps - 0.5);
    return edges;
}

std::vector<double> scan_angles_rad(const SonarConfig& config) {
    const std::vector<double> edges = scan_edges_rad(config);
    const std::size_t sweeps = config.sector_deg < 360.0 ? 2 : 1;
    std::vector<double> angles(sweeps * scan_steps(config));
    for (std::size_t ping = 0; ping < angles.size(); ++ping) {
        const int step = scan_step(config, ping);
        angles[ping] = 0.5 * (edges[step] + edges[step + 1]);
    }
    return angles;
}

Sonar whole_scan(const Sonar& sonar) {
    Sonar whole = sonar;
    whole.settings.view.azimuth_rad = radians(sonar.config.sector_deg);
    whole.settings.view.beams = scan_steps(sonar.config);
    whole.azimuth_edges_rad = scan_edges_rad(sonar.config);
    return whole;
}

ScanDisplay::ScanDisplay(const Sonar& sonar) : config_(sonar.config) {
    image_.range_bins = config_.range_bins;
    image_.beams = scan_steps(config_);
    image_.intensity.resize(static_cast<std::size_t>(image_.range_bins) * image_.beams);
}

void ScanDisplay::show(std::size_t ping, std::span<const float> bins) {
    const auto step = static_cast<std::size_t>(scan_step(config_, ping));
    for (std::size_t i = 0; i < bins.size(); ++i)
        image_.intensity[i * image_.beams + step] = bins[i];
}

}  // namespace sonarsim
