#pragma once

#include <nlohmann/json.hpp>

#include "dataset/layout.h"
#include "dataset/shared_products.h"

namespace sonarsim {

/// Writes a COCO file of the objects in the waterfalls and echograms of a dataset: a picture each.
/// Where one row or column of it stands for several pings, it shows what is in any of them. An
/// object that is not seen for 32 pings and then again is another annotation. Ids go on where those
/// of the pings end (write_coco()). In memory are the ids of the bins of one picture. `description`
/// is dataset.json.
void write_record_coco(const Layout& layout, const nlohmann::ordered_json& description,
                       const SharedProduct& product);

}  // namespace sonarsim
