#include "input/mission/resolved.h"

#include "core/hash.h"
#include "input/mission/files.h"
#include "input/mission/mission.h"
#include "input/mission/writer.h"

namespace sonarsim {

std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars) {
    Mission copy = mission;  // describe() takes no const mission
    MissionWriter writer(sonars);
    describe(writer, copy);
    return writer.yaml();
}

Mission portable(const Mission& mission) {
    Mission copy = mission;
    const std::filesystem::path home = home_of(mission);
    for_each_file(copy,
                  [&](std::filesystem::path& path) { path = path.lexically_proximate(home); });
    copy.output.folder.clear();
    return copy;
}

std::string mission_hash(const Mission& mission, SonarKeyTable sonars) {
    return fnv1a_128(resolved_yaml(portable(mission), sonars));
}

}  // namespace sonarsim
