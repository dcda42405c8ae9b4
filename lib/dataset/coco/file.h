#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/atomic_file.h"

namespace sonarsim {

/// A COCO file on its way: lists of images and then of annotations, written item by item.
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
    bool first_ = true;  ///< of its list
};

/// What an annotation is of, and where.
struct CocoAnnotation {
    std::uint64_t id = 0;
    std::uint64_t image_id = 0;
    std::uint64_t instance = 0;
    nlohmann::ordered_json category;
    std::int64_t left = 0, top = 0, width = 0, height = 0;  ///< of its box
    std::uint64_t area = 0;
    std::uint64_t image_width = 0, image_height = 0;
    std::string counts;  ///< coco_counts() of its mask
};
nlohmann::ordered_json annotation_json(const CocoAnnotation& annotation);

}  // namespace sonarsim
