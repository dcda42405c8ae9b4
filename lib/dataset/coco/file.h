#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/atomic_file.h"
#include "dataset/layout.h"
#include "product/object_masks.h"

namespace sonarsim {

/// A COCO file: lists of images and then of annotations, written item by item.
class CocoFile {
  public:
    /// Names the categories, the classes of dataset.json (`description`).
    CocoFile(const std::filesystem::path& path, const nlohmann::ordered_json& description);

    void begin_list(const char* key);
    void add(const nlohmann::ordered_json& item);
    void end_list();
    void finish();

  private:
    StreamedFile file_;
    bool first_ = true;  ///< the next item is the first of its list
};

/// An object in a picture.
struct CocoAnnotation {
    std::uint64_t id = 0;
    std::uint64_t image_id = 0;
    std::uint64_t instance = 0;
    nlohmann::ordered_json category;
    std::int64_t left = 0, top = 0, width = 0, height = 0;  ///< its box, px
    std::uint64_t area = 0;
    std::uint64_t image_width = 0, image_height = 0;
    std::string counts;  ///< coco_counts() of its mask
};
nlohmann::ordered_json annotation_json(const CocoAnnotation& annotation);

/// The annotation of a mask in a picture of this size, px, without its ids and its category.
CocoAnnotation mask_annotation(const ObjectMask& mask, std::uint64_t width, std::uint64_t height);

/// The picture of a sensor in dataset.json (`sensor`) whose objects are labelled, by "sensor" or
/// "sweep"; null for none. InputError when an older program wrote the dataset.
const nlohmann::ordered_json* labelled_picture(const nlohmann::ordered_json& sensor,
                                               const char* per);

/// The records of the ids of instances; null for none.
const PingRecord* instance_record(const SensorLayout& sensor);

}  // namespace sonarsim
