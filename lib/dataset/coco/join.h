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

/// A dataset in the common folder.
struct CocoMember {
    std::string folder;                ///< name of its folder
    SplitPart part = SplitPart::none;  ///< the part of the split that it belongs to as a whole
    std::string program_version;       ///< version of the program that made it
    std::vector<std::string> classes;  ///< names of the classes 1, 2, ...
    AnnotationRules rules;             ///< rules of its annotations
    std::vector<std::string> files;    ///< its COCO files, "labels/coco.json"
    std::uint64_t image_ids = 0;       ///< an upper limit of the ids of its images
};

CocoMember coco_member(const DatasetFile& dataset, const std::string& folder, SplitPart part);

/// The names of the joined label files: a COCO file for each that a member has and, if members
/// belong to a part of a split, "labels/coco_train.json" and so on. If there are any, also
/// statistics.json.
std::vector<std::string> joined_label_files(std::span<const CocoMember> members);

/// The names of all label files that joining may make: for all sorts of pictures and all parts of a
/// split.
std::vector<std::string> all_joined_label_files();

/// The classes that at least one member annotates, in the order in which the members first name
/// them.
std::vector<std::string> classes_of(std::span<const CocoMember> members);

/// Writes the joined label files into `folder`, which holds the members. The categories are
/// `classes` with the ids 1, 2, ...; a category of a member gets the id of its name. To keep ids
/// unique in all files, ids of images grow by the sum of `image_ids` of the members before, and ids
/// of annotations by 65536 times this sum. Paths start at `folder`. InputError when a file of a
/// member is damaged.
void write_joined_labels(const std::filesystem::path& folder, std::span<const CocoMember> members,
                         const std::vector<std::string>& classes, const std::string& description);

}  // namespace sonarsim
