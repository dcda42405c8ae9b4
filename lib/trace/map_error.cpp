#include "trace/map_error.h"

#include <algorithm>
#include <vector>

#include "trace/arrivals.h"
#include "trace/lay_maps.h"
#include "visibility/image_change.h"

namespace sonarsim {

namespace {

// The most beams to compare.
constexpr std::size_t most_beams = 16;

/// One of the two images of some beams.
Samples image_of(std::span<const ComparedBeam* const> beams,
                 std::vector<Sample> ComparedBeam::*samples) {
    Samples out;
    out.beam_begin.push_back(0);
    for (const ComparedBeam* beam : beams) {
        const std::vector<Sample>& items = beam->*samples;
        out.items.insert(out.items.end(), items.begin(), items.end());
        out.beam_begin.push_back(static_cast<std::uint32_t>(out.items.size()));
    }
    return out;
}

}  // namespace

double growth_by_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                      std::span<const ComparedBeam> compared) {
    const std::size_t every = (compared.size() + most_beams - 1) / most_beams;
    std::vector<const ComparedBeam*> beams;
    for (std::size_t k = 0; k < compared.size(); k += every)
        beams.push_back(&compared[k]);
    View part = view;
    part.beams = static_cast<int>(beams.size());
    Samples one = image_of(beams, &ComparedBeam::one);
    Samples other = image_of(beams, &ComparedBeam::other);
    const auto change = [&] {
        return image_change(mean_echoes(scene, part, one), mean_echoes(scene, part, other));
    };
    const double without = change();
    if (!(without > 0.0)) return 1.0;
    std::vector<Sample> none;
    for (Samples* const samples : {&one, &other})
        lay_maps(*scene.maps, view, T_world_sensor, *samples, none, 1.0, scene.sound_profile.get());
    return std::max(change() / without, 1.0);
}

double error_of_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                     const Samples& samples) {
    // The pieces of a side-scan end where bins do: their means are exact.
    if (view.shape == ViewShape::port_starboard) return 0.0;
    constexpr int blocks = 128;  // equal parts of the range
    // One block in `every` is compared. A view of few beams needs all, since the borders of a map
    // may lie in few of them.
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
