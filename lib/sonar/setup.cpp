#include "sonar/setup.h"

#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

std::vector<double> edges(double low, double high, int bins) {
    std::vector<double> out(bins + 1);
    for (int i = 0; i < bins; ++i)
        out[i] = low + (high - low) * i / bins;
    out[bins] = high;
    return out;
}

Pose mounted(const MountConfig& mount, const Pose& T_vehicle_default) {
    const Pose turned{rotation_from_rpy(radians(mount.rpy_deg[0]), radians(mount.rpy_deg[1]),
                                        radians(mount.rpy_deg[2])),
                      Eigen::Vector3d(mount.translation_m.data())};
    return turned * T_vehicle_default;
}

std::uint32_t stream_of(std::string_view sensor_name) {
    // FNV-1a.
    std::uint32_t hash = 2166136261U;
    for (const char c : sensor_name)
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return hash;
}

PixelNoise pixel_noise(const SonarConfig& config, double gain,
                       std::span<const double> range_edges_m,
                       std::span<const double> azimuth_edges_rad) {
    const NoiseConfig& noise = config.noise;
    PixelNoise out{static_cast<float>(gain), static_cast<float>(noise.add_sigma),
                   static_cast<float>(noise.mult_sigma),
                   std::vector<float>(range_edges_m.size() - 1, 1.0F),
                   std::vector<float>(azimuth_edges_rad.size() - 1, 1.0F)};
    if (!noise.scale_with_range) return out;
    for (std::size_t i = 0; i < out.range_scale.size(); ++i) {
        const double r = 0.5 * (range_edges_m[i] + range_edges_m[i + 1]) / config.range_max_m;
        out.range_scale[i] = static_cast<float>(r * r);
    }
    const double sigma =
        radians(noise.lobe_sigma_deg > 0.0 ? noise.lobe_sigma_deg : config.azimuth_deg / 8.0);
    for (std::size_t j = 0; j < out.lobe_scale.size(); ++j) {
        const double phi = 0.5 * (azimuth_edges_rad[j] + azimuth_edges_rad[j + 1]) / sigma;
        out.lobe_scale[j] = static_cast<float>(1.0 + 0.5 * exponential(-0.5 * phi * phi));
    }
    return out;
}

}  // namespace sonarsim
