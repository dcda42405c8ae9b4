#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "assembly/assemble.h"
#include "mission/mission.h"
#include "ping/labels.h"

namespace sonarsim {

/// What label_ping() has to find for these labels.
LabelRequest label_request(std::span<const Label> labels);

/// For dataset.json: what the ids of the labels stand for. Of an instance also the box around all
/// of it, world frame, m; null where none of its triangles is in the scene.
nlohmann::ordered_json describe_label_ids(const Assembly& assembly);

}  // namespace sonarsim
