#pragma once

#include <nlohmann/json.hpp>

#include "dataset/layout.h"
#include "mission/mission.h"

namespace sonarsim {

/// Writes the facts of the objects in the records of sonars, made from instance.npy,
/// object_shadow.npy, visible_share.npy and the echoes: NAME/objects.json for the picture of all
/// pings (waterfall, echogram), NAME/objects_NNNN.json for the picture of each sweep. In the former
/// an object has an entry for each side and each pass; after 32 pings that do not show it, it
/// begins another pass. `description` is dataset.json.
void write_record_objects(const Layout& layout, const Mission& mission,
                          const nlohmann::ordered_json& description);

}  // namespace sonarsim
