#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dataset/coco/file.h"
#include "dataset/label_description.h"
#include "dataset/split.h"
#include "product/object_masks.h"

namespace sonarsim {

/// A picture of a dataset that COCO files list, with what is needed to read it.
struct SourcePicture {
    enum class Kind { ping, strip, sweep };

    Kind kind = Kind::ping;
    std::uint64_t id = 0;
    std::filesystem::path file;  ///< the picture, or the pack that holds it
    std::string member;          ///< its name in the pack; empty for a loose file
    std::string name;            ///< the name of the exported picture: "variant_0003-fls-000012"
    std::string sensor;
    int width = 0;
    int height = 0;
    double full_scale = 0.0;     ///< intensity that is white, for arrays of intensities
    bool rows_are_pings = true;  ///< in strips; else the columns are
    std::optional<int> nadir;    ///< column at which starboard begins
    LabelBox box = LabelBox::object;
    int min_pixels = 1;  ///< the least pixels of an object, by the dataset's own rule
    /// The part of each row or column of pings of a strip; one part for any other picture.
    std::vector<SplitPart> parts;
};

/// A dataset that is exported.
struct SourceDataset {
    std::filesystem::path folder;
    std::string name;  ///< the name of its folder among others; empty if it is alone
    nlohmann::ordered_json
        description;  ///< mission, hashes and version, for the files of an export
    std::vector<std::string> classes;
    AnnotationRules rules;  ///< rules by which it annotates objects
    std::vector<std::string> coco_files;
    std::vector<SourcePicture> pictures;
};

/// All datasets of an output folder: one, packed or loose, the variants of a mission, or those of a
/// collection.
struct ExportSource {
    std::vector<std::string> classes;  ///< the classes of objects: number k is entry k - 1
    std::vector<SourceDataset> datasets;
};

/// An object in a picture. `mask.id` is the number of its instance in its dataset.
struct SourceObject {
    int class_number = 0;  ///< in ExportSource::classes, from 1 on; 0: is no object
    ObjectMask mask;
    PixelBox box;  ///< box by the dataset's rules
    bool is_crowd = false;
    SeenFacts seen;  ///< facts of the whole object, with the box of the shadow in the picture
};

}  // namespace sonarsim
