#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "product/annotation.h"
#include "product/contrast.h"
#include "product/object_masks.h"

namespace sonarsim {

/// The values of successive pings, [lines, bins].
struct RecordValues {
    RecordValues(int line_count, int bin_count, bool is_full_turn = false);
    LevelMap map() const { return {lines, bins, object, shadow, level, full_turn}; }
    /// The box of the bins in `within` that show the shadow of an object; empty for none.
    BinBox shadow_box(std::uint16_t id, const BinBox& within) const;

    int lines, bins;
    bool full_turn;  ///< the last line is next to the first
    std::vector<std::uint16_t> object, shadow;
    std::vector<std::uint16_t> visible_share;  ///< 65535 is all of the object, 0: not known
    std::vector<float> level;
};

/// The records of a sensor, and the names of what they show. `description` is dataset.json and must
/// outlive it.
struct ObjectRecords {
    ObjectRecords(const Layout& layout, std::size_t sensor,
                  const nlohmann::ordered_json& description);

    /// Reads `count` pings from `first` on into the lines from `line` on.
    void read(std::size_t first, std::size_t count, std::size_t line, RecordValues& values) const;
    std::size_t pings() const { return object.records(); }

    const nlohmann::ordered_json& labels;     ///< the labels in dataset.json
    const nlohmann::ordered_json& described;  ///< the sensor in dataset.json
    RecordFile object, shadow, visible_share, level;
    std::vector<std::uint8_t> is_background{1};  ///< indexed by id
    std::vector<double> range_m;                 ///< middle of each range bin
};

/// The facts of an object in a picture. Those that are not known are empty.
struct SeenObject {
    std::uint16_t id = 0;
    BinBox box, shadow;          ///< lines are pings, or steps of a sweep
    double range_m = 0.0;        ///< sum over its bins
    double visible_share = 0.0;  ///< the same; 65535 is all of it
    int bins = 0, bins_with_share = 0;
    const char* side = nullptr;  ///< port or starboard, in a side-scan sonar
    std::optional<double> bearing_deg, contrast_db, shadow_contrast_db;
    std::pair<std::size_t, std::size_t> pings;  ///< the first and the one after the last
    std::optional<PixelBox> shadow_px;
    bool clipped = false;

    void add(int line, int bin, double bin_range_m, std::uint16_t share);
    /// Compares the object in `own` and its shadow in `own_shadow` with their surroundings.
    void add_contrasts(const ObjectRecords& records, const RecordValues& values, const BinBox& own,
                       const BinBox& own_shadow);
    nlohmann::ordered_json json(const ObjectRecords& records, const ObjectMask& mask) const;
};

/// Writes the objects of a picture, a line each; `head` says which picture it is.
void write_objects(const std::filesystem::path& path, const nlohmann::ordered_json& head,
                   const std::vector<nlohmann::ordered_json>& objects);

}  // namespace sonarsim
