#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset_file.h"
#include "dataset/label_description.h"
#include "dataset/split.h"

// COCO files of several datasets that lie side by side in one folder.

namespace sonarsim {

/// A dataset in the folder of all.
struct CocoMember {
    std::string folder;                ///< its name in the folder of all
    SplitPart part = SplitPart::none;  ///< to which all of it belongs
    std::string program_version;       ///< that made it
    std::vector<std::string> classes;  ///< names of the classes 1, 2, ...
    AnnotationRules rules;             ///< that it annotates by
    std::vector<std::string> files;    ///< its COCO files, "labels/coco.json"
    std::uint64_t image_ids = 0;       ///< an upper limit of the ids of its images
};

CocoMember coco_member(const DatasetFile& dataset, const std::string& folder, SplitPart part);

/// The names of the joined label files. There is a COCO file for each that a member has, and for
/// members of a part of a split "labels/coco_train.json" and so on besides; with them there is
/// statistics.json.
std::vector<std::string> joined_label_files(std::span<const CocoMember> members);

/// All joined label files that some members may have: every sort of pictures, every part of a
/// split.
std::vector<std::string> all_joined_label_files();

/// The classes that some member annotates, in the order in which the members name them first.
std::vector<std::string> classes_of(std::span<const CocoMember> members);

/// Writes the joined label files into `folder`, where the members lie. The categories are `classes`
/// with the ids 1, 2, ...; a category of a member is that of its name. Ids of images grow by the
/// sum of `image_ids` of the members before, those of annotations by 65536 times that, so that they
/// are unique in all files. Paths start at `folder`. InputError when a file of a member is damaged.
void write_joined_labels(const std::filesystem::path& folder, std::span<const CocoMember> members,
                         const std::vector<std::string>& classes, const std::string& description);

}  // namespace sonarsim
