#include "assembly/buried_objects.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "calibrated/sediment_paths.h"
#include "calibrated/water.h"
#include "core/error.h"
#include "core/text.h"
#include "trace/target_shapes.h"

namespace sonarsim {

std::vector<SedimentPath> sediments_of(const Mission& mission, const Scene& scene,
                                       const Sonar& sonar) {
    const WaterConfig& water = mission.water;
    const double frequency_hz = sonar.config.instrument.frequency_hz;
    const WaterState state{water.temperature_c, water.salinity_psu, water.depth_m};
    return sediment_paths(scene.materials, {water.density_kg_m3, water.sound_speed_m_s},
                          frequency_hz, absorption_db_per_m(frequency_hz, state));
}

void bury_objects(const Mission& mission, std::span<const PlacedFile> files, const Scene& scene,
                  std::span<Sonar> sonars) {
    std::map<std::string_view, Location> places;  // in the mission, by instance
    for (const PlacedFile& file : files) {
        if (file.buried) places.emplace(file.name, file.place);
    }
    if (places.empty()) return;
    for (Sonar& sonar : sonars) {
        BuriedObjects buried{.instances = {}, .sediments = sediments_of(mission, scene, sonar)};
        const auto& targets = sonar.settings.targets;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
            const auto place = places.find(scene.instances[i]);
            if (place == places.end()) continue;
            if (!targets || std::ranges::find(targets->placed, i, &PlacedTarget::instance) ==
                                targets->placed.end()) {
                throw InputError(place->second,
                                 "'" + printable(scene.instances[i]) +
                                     "' is buried and has more than 20,000 triangles or a radius "
                                     "of more than 5 m: use a smaller or coarser mesh");
            }
            buried.instances.push_back(i);
        }
        sonar.settings.buried = std::make_shared<const BuriedObjects>(std::move(buried));
    }
}

}  // namespace sonarsim
