#include "assembly/buried_objects.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "assembly/placed_files.h"
#include "calibrated/sediment_paths.h"
#include "calibrated/water.h"
#include "core/error.h"
#include "trace/target_shapes.h"

namespace sonarsim {

std::vector<SedimentPath> sediments_of(const Mission& mission, const Scene& scene,
                                       const Sonar& sonar) {
    const WaterConfig& water = mission.water;
    const double frequency_hz = sonar.config.instrument.frequency_hz;
    const WaterState state{water.temperature_c, water.salinity_psu, water.depth_m, water.ph};
    return sediment_paths(scene.materials, {water.density_kg_m3, water.sound_speed_m_s},
                          frequency_hz, absorption_db_per_m(frequency_hz, state));
}

void bury_objects(const Mission& mission, const Scene& scene, std::span<Sonar> sonars) {
    if (std::ranges::none_of(mission.scene.objects, &ObjectConfig::buried)) return;
    for (Sonar& sonar : sonars) {
        BuriedObjects buried{.instances = {}, .sediments = sediments_of(mission, scene, sonar)};
        for (const ObjectConfig& object : mission.scene.objects) {
            if (!object.buried) continue;
            const auto instance = static_cast<std::uint32_t>(
                std::ranges::find(scene.instances, object.name) - scene.instances.begin());
            const auto& targets = sonar.settings.targets;
            if (!targets || std::ranges::find(targets->placed, instance, &PlacedTarget::instance) ==
                                targets->placed.end()) {
                throw InputError(object.place.location,
                                 title_of(object) +
                                     " is buried and has more than 20,000 triangles or a radius "
                                     "of more than 5 m: use a smaller or coarser mesh");
            }
            buried.instances.push_back(instance);
        }
        std::ranges::sort(buried.instances);
        sonar.settings.buried = std::make_shared<const BuriedObjects>(std::move(buried));
    }
}

}  // namespace sonarsim
