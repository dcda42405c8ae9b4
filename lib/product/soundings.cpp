#include "product/soundings.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

struct Run {
    int begin;
    int end;
};

/// The bins around the peak of a beam that are at least half as bright; empty in the dark.
Run run_around_peak(const std::vector<float>& beam) {
    const int n = static_cast<int>(beam.size());
    const auto at = [&](int i) { return i < 0 || i >= n ? 0.0F : beam[i]; };
    int best = 0;
    float best_sum = 0.0F;
    for (int i = 0; i < n; ++i) {
        const float sum = at(i - 1) + at(i) + at(i + 1);
        if (sum > best_sum) {
            best_sum = sum;
            best = i;
        }
    }
    int peak = best;
    for (const int i : {best - 1, best + 1}) {
        if (at(i) > at(peak)) peak = i;
    }
    if (!(at(peak) > 0.0F)) return {0, 0};
    const float half = 0.5F * beam[peak];
    Run run{peak, peak + 1};
    while (run.begin > 0 && beam[run.begin - 1] >= half)
        --run.begin;
    while (run.end < n && beam[run.end] >= half)
        ++run.end;
    return run;
}

/// Range and quality of one beam.
Sounding sound(const Sonar& sonar, const std::vector<float>& beam) {
    const Run run = run_around_peak(beam);
    if (run.begin == run.end) return {};
    double inside = 0.0;
    double moment = 0.0;
    double all = 0.0;
    for (const float value : beam)
        all += value;
    for (int i = run.begin; i < run.end; ++i) {
        inside += beam[i];
        moment += beam[i] * 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
    }
    const int length = run.end - run.begin;
    const int others = static_cast<int>(beam.size()) - length;
    const double outside_mean = others > 0 ? std::max(0.0, all - inside) / others : 0.0;
    Sounding sounding;
    sounding.range_m = moment / inside;
    sounding.quality = std::clamp(1.0 - outside_mean * length / inside, 0.0, 1.0);
    return sounding;
}

}  // namespace

std::vector<Sounding> find_soundings(const Sonar& sonar, const Pose& T_world_vehicle,
                                     const Ping& ping) {
    const Pose T_world_sensor = T_world_vehicle * sonar.T_vehicle_sensor;
    const std::vector<float>& growth = sonar.settings.pixel_noise.range_scale;
    std::vector<Sounding> soundings(ping.beams);
    std::vector<float> beam(ping.range_bins);
    for (int j = 0; j < ping.beams; ++j) {
        for (int i = 0; i < ping.range_bins; ++i)
            beam[i] = ping.at(i, j) / growth[i];
        soundings[j] = sound(sonar, beam);
        if (std::isnan(soundings[j].range_m)) continue;
        const SinCos azimuth =
            sincos(0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]));
        const Eigen::Vector3d ray(azimuth.cos, azimuth.sin, 0.0);
        soundings[j].position =
            T_world_sensor.rotation * (soundings[j].range_m * ray) + T_world_sensor.translation;
    }
    return soundings;
}

}  // namespace sonarsim
