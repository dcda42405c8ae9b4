#include "mission/resolved.h"

#include "core/hash.h"
#include "mission/files.h"
#include "mission/parse.h"
#include "mission/schema.h"
#include "mission/writer.h"

namespace sonarsim {

std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars) {
    Mission copy = mission;  // describe() takes no const mission
    MissionWriter writer(sonars);
    describe(writer, copy);
    return writer.yaml();
}

Mission parse_resolved(std::string_view text, const std::string& file_name, SonarKeyTable sonars) {
    // Make the base folder as deep as the paths climb, so that portable() gives the original paths.
    constexpr std::size_t deepest = 1000;
    std::size_t climbs = 0;
    for (std::size_t at = text.find(".."); at != text.npos && climbs < deepest;
         at = text.find("..", at + 2))
        ++climbs;
    std::filesystem::path base = "/";
    for (std::size_t k = 0; k <= climbs; ++k)
        base /= "folder";
    return parse_mission(text, file_name, base, {}, sonars);
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
