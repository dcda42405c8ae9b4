#include "trace/map_error.h"

#include <algorithm>
#include <vector>

#include "trace/arrivals.h"
#include "trace/lay_maps.h"
#include "visibility/image_change.h"

namespace sonarsim {

double error_of_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                     const Samples& samples) {
    constexpr int blocks = 128;  // equal parts of the range
    // One in so many of them is looked at. The borders of a map may lie in few of them, so that a
    // side-scan of two beams needs all.
    const int every = std::clamp(view.beams / 8, 1, 16);
    constexpr double coarser = 2.0;
    Samples usual;
    usual.beam_begin.push_back(0);
    const double per_m = blocks / (view.range_max_m - view.range_min_m);
    for (int beam = 0; beam < view.beams; ++beam) {
        for (const Sample& sample : samples.beam(beam)) {
            const auto range = static_cast<double>(arrival_range(sample.position));
            const int block = static_cast<int>((range - view.range_min_m) * per_m);
            if ((block + beam) % every == 0) usual.items.push_back(sample);
        }
        usual.beam_begin.push_back(static_cast<std::uint32_t>(usual.items.size()));
    }
    Samples coarse = usual;
    std::vector<Sample> none;
    lay_maps(*scene.maps, view, T_world_sensor, usual, none, 1.0, scene.sound_profile.get());
    lay_maps(*scene.maps, view, T_world_sensor, coarse, none, coarser, scene.sound_profile.get());
    return image_change(mean_echoes(scene, view, coarse), mean_echoes(scene, view, usual));
}

}  // namespace sonarsim
