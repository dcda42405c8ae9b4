#pragma once

#include <nlohmann/json.hpp>

#include "dataset/layout.h"
#include "mission/mission.h"

namespace sonarsim {

/// Makes the files of shared_products() in a dataset that has all its pings. `description` is
/// dataset.json.
void write_shared_products(const Layout& layout, const Mission& mission,
                           const nlohmann::ordered_json& description);

}  // namespace sonarsim
