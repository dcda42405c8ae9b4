#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dataset/split.h"
#include "mission/mission.h"

namespace sonarsim {

/// The pictures of pings that COCO files list.
enum class CocoPicture {
    polar,
    fan,
    record,  ///< all pings of a sensor: waterfalls and echograms
    scan,    ///< sweeps of a scanning sonar
};

/// A file of the dataset that belongs to no single sonar. Most are made from the pings of all
/// sonars, once all of these are rendered; files of the kind `initial` are written before the first
/// ping.
struct SharedProduct {
    enum class Kind {
        coco,
        class_names,
        split,
        statistics,
        initial,  ///< written first: files of a generated sea bed, reported poses
    };
    Kind kind;
    std::string file;                  ///< relative to the folder of the dataset
    CocoPicture picture = {};          ///< COCO only: its pictures
    SplitPart part = SplitPart::none;  ///< the poses that it lists; none: all
};

/// The counts of the annotations in the COCO files, relative to the folder of the dataset.
inline constexpr const char* statistics_name = "labels/statistics.json";

/// The COCO file of all pictures of a sort, or of a part of the split ("_train"), relative to the
/// folder of the dataset.
std::string coco_file(CocoPicture picture, const std::string& part = "");

/// The shared products that a mission asks for.
std::vector<SharedProduct> shared_products(const Mission& mission);

/// InputError when the mission asks for labels of pictures and writes no such picture, or when a
/// part of the split would get no pose.
void check_shared_products(const Mission& mission, std::size_t poses);

}  // namespace sonarsim
