#include "simulate/assembly/engines.h"

#include "simulate/sonar/setup.h"

namespace sonarsim {

std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineKind::octree)
        settings.caster = std::make_shared<const Caster>(assembly.make_caster());
    return make_engine(assembly.scene, settings);
}

}  // namespace sonarsim
