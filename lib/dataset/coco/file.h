#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/atomic_file.h"
#include "dataset/layout.h"
#include "mission/label_config.h"
#include "product/annotation.h"
#include "product/object_masks.h"

namespace sonarsim {

/// A COCO file: lists of images and then of annotations, written item by item.
class CocoFile {
  public:
    /// Names the categories, the classes of dataset.json (`description`) that are no background.
    CocoFile(const std::filesystem::path& path, const nlohmann::ordered_json& description);

    void begin_list(const char* key);
    void add(const nlohmann::ordered_json& item);
    void end_list();
    void finish();

  private:
    StreamedFile file_;
    bool first_ = true;  ///< the next item is the first of its list
};

/// The place of an object and how well it is seen. Facts that are not known are empty.
struct SeenFacts {
    std::optional<double> range_m;      ///< mean over its bins
    std::optional<double> bearing_deg;  ///< off the sonar's heading, positive to starboard
    const char* side = nullptr;  ///< port or starboard; null for other sonars than side-scans
    std::optional<double> contrast_db;
    std::optional<double> visible_share;
    std::optional<PixelBox> shadow;
    std::optional<double> shadow_contrast_db;
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
    bool is_crowd = false;
    SeenFacts seen = {};
};
nlohmann::ordered_json annotation_json(const CocoAnnotation& annotation);

/// Applies the rules to an annotation whose box is the box of the object: sets the annotation's box
/// and whether it is a crowd. False if the picture does not annotate the object.
bool apply_rules(const LabelConfig& rules, bool is_background, CocoAnnotation& annotation);

/// The annotation of a mask in a picture of this size, px, without its ids and its category.
CocoAnnotation mask_annotation(const ObjectMask& mask, std::uint64_t width, std::uint64_t height);

/// The picture of a sensor in dataset.json (`sensor`) whose objects are labelled, by "sensor" or
/// "sweep"; null for none. InputError when an older program wrote the dataset.
const nlohmann::ordered_json* labelled_picture(const nlohmann::ordered_json& sensor,
                                               const char* per);

/// The records of a label, or of the echoes (""); null for none.
const PingRecord* record_of_label(const SensorLayout& sensor, std::string_view label);

}  // namespace sonarsim
