#pragma once

#include <nlohmann/json.hpp>

#include "dataset/layout.h"
#include "dataset/shared_products.h"
#include "mission/mission.h"

namespace sonarsim {

/// Writes a COCO file of the objects in the round pictures of scanning sonars, one for each sweep,
/// as they stand in the picture: a step that a sweep has not reached shows what it showed before.
/// Ids go on where those of waterfalls and echograms end (write_record_coco()), an annotation's is
/// as in write_coco(). `description` is dataset.json.
void write_scan_coco(const Layout& layout, const Mission& mission,
                     const nlohmann::ordered_json& description, const SharedProduct& product);

}  // namespace sonarsim
