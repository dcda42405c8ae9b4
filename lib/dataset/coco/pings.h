#pragma once

#include <nlohmann/json.hpp>

#include "dataset/layout.h"
#include "dataset/shared_products.h"

namespace sonarsim {

inline constexpr std::uint64_t ids_per_image = 65536;

/// Writes a COCO file of the objects of every ping, as its objects/NNNNNN.json tells them. Of the
/// memory it takes only that of a ping grows with the dataset. An image's id is 1 + the index of
/// the ping in the mission, twice, and 1 more for the fan; that of an annotation 65536 times as
/// much and the instance: the same in every part, and never twice in all COCO files of a dataset.
/// `description` is dataset.json.
void write_coco(const Layout& layout, const nlohmann::ordered_json& description,
                const SharedProduct& product, const std::vector<SplitPart>& part_of_pose);

}  // namespace sonarsim
