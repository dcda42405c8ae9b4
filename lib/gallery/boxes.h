#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "dataset/checked_json.h"
#include "dataset/dataset_file.h"

namespace sonarsim {

/// Hands the JSON of a file of a dataset to `use`. InputError with the file when it is no JSON, or
/// not what `use` expects of it.
template <class Use>
void use_json(const std::filesystem::path& file, const std::string& text, const Use& use) {
    try {
        use(parse_json(text, file.string()));
    } catch (const nlohmann::json::exception&) {
        throw InputError({file.string()}, "is not what sonarsim writes; run sonarsim verify");
    } catch (const std::out_of_range&) {
        throw InputError({file.string()},
                         "has ids that dataset.json does not; run sonarsim verify");
    }
}

/// The names that boxes carry: those of the instances in dataset.json, by id - 1, then those of its
/// classes, for boxes that name a class only.
struct BoxLabels {
    explicit BoxLabels(const DatasetFile& dataset);

    std::size_t of_instance(std::uint64_t id) const;        ///< id from 1 on
    std::size_t of_class(std::uint64_t class_index) const;  ///< class id - 1

    std::size_t instances = 0;
    std::size_t classes = 0;
};

// A box is [label, x, y, width, height, details], px. `details` has the `mask` as COCO's tools
// compress it, the box of the shadow and the numbers of the annotation.

/// The details of an annotation or an object, which may have no mask. Numbers have five digits.
/// InputError when the mask does not fit a picture of this size, px.
nlohmann::ordered_json details_of(const CheckedJson& annotation,
                                  const std::optional<CheckedJson>& mask, std::uint64_t width,
                                  std::uint64_t height);

/// The boxes in a picture.
struct ListedBoxes {
    std::uint64_t width = 0;  ///< size of the labelled picture, px
    std::uint64_t height = 0;
    nlohmann::ordered_json boxes = nlohmann::ordered_json::array();
};

/// The boxes in the COCO files of a dataset, which are those that a network is trained with.
struct CocoBoxes {
    /// Boxes in pictures of all pings of a sensor and of sweeps, by the picture's path from the
    /// dataset's folder.
    std::map<std::string, ListedBoxes> of_file;
    /// Boxes in pictures of single pings, by sensor and number of the pose.
    using OfPings = std::map<std::pair<std::string, std::uint64_t>, ListedBoxes>;
    OfPings in_image;  ///< beams to the right, ranges down
    OfPings in_fan;
};

/// Empty if the dataset has no COCO files. InputError, with the line, when one is damaged.
CocoBoxes coco_boxes(const std::filesystem::path& folder, const BoxLabels& labels);

}  // namespace sonarsim
