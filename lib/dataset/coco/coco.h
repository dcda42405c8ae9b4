#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "dataset/layout.h"
#include "dataset/shared_products.h"
#include "mission/mission.h"

namespace sonarsim {

// The writers of COCO files, one for each sort of pictures. `description` is dataset.json.

inline constexpr std::uint64_t ids_per_image = 65536;

/// Writes COCO files of the objects of every ping, from the files objects/NNNNNN.json, which are
/// read once. Only one ping is in memory at a time. The ids of images are 2 k + 1, for the fan 2 k
/// + 2, with the index k of the ping in the mission; the id of an annotation is 65536 times the id
/// of the image plus the instance. Ids are the same in every part of a split, and unique in all
/// COCO files of a dataset.
void write_coco(const Layout& layout, const nlohmann::ordered_json& description,
                std::span<const SharedProduct> products,
                const std::vector<SplitPart>& part_of_pose);

/// Writes a COCO file of the objects in the strips of a dataset (waterfalls and echograms), one
/// picture per sonar. A row or column that stands for several pings shows the objects of each of
/// them. An object that no ping shows for more than 32 pings gets a new annotation when it is seen
/// again. Ids continue those of write_coco(). The ids of the bins of one picture are in memory.
void write_record_coco(const Layout& layout, const nlohmann::ordered_json& description,
                       const SharedProduct& product);

/// Writes a COCO file of the objects in the round pictures of scanning sonars, one for each sweep.
/// A step that an unfinished sweep has not reached shows the sweep before. Ids of images continue
/// those of write_record_coco(); ids of annotations are as in write_coco().
void write_scan_coco(const Layout& layout, const Mission& mission,
                     const nlohmann::ordered_json& description, const SharedProduct& product);

}  // namespace sonarsim
