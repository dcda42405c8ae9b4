#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dataset/coco/file.h"
#include "dataset/label_description.h"
#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "product/contrast.h"

namespace sonarsim {

/// The values of successive pings from which annotations are made, [lines, bins].
struct RecordValues {
    int lines = 0, bins = 0;
    std::vector<std::uint16_t> object, shadow;
    /// Share of the bin's object; 65535 is all of it, 0: not known.
    std::vector<std::uint16_t> visible_share;
    std::vector<float> level;  ///< empty: the sensor has no records of echoes
    bool full_turn = false;    ///< the last line is next to the first

    void resize(int new_lines, int new_bins);
};

/// The files of these values of a sensor. Records of shadows and visible shares may be missing;
/// then these facts stay unknown.
class AnnotationRecords {
  public:
    AnnotationRecords(const Layout& layout, std::size_t sensor);

    std::size_t pings() const { return object_->records(); }
    /// Reads the objects in the bins of a ping.
    void read_objects(std::size_t ping, std::span<std::uint16_t> objects) const {
        object_->read(ping, std::as_writable_bytes(objects));
    }
    /// Reads `count` pings from `first` on into the lines from `line` on of `values`, which must
    /// have room for them.
    void read(std::size_t first, std::size_t count, std::size_t line, RecordValues& values) const;

  private:
    std::optional<RecordFile> object_, shadow_, visible_share_, level_;
};

/// For each id of an instance: 1 if it is background. `labels` is that of dataset.json.
std::vector<std::uint8_t> background_ids(const nlohmann::ordered_json& labels,
                                         const AnnotationRules& rules);

/// The mean range and visible share of an object, of whose bins those with a known share count.
class ObjectMeans {
  public:
    void add(const RecordValues& values, std::uint16_t id, const BinBox& box,
             std::span<const double> range_m);
    bool is_empty() const { return bins_ == 0; }
    void give_to(SeenFacts& seen) const;

  private:
    double range_m_ = 0.0, share_ = 0.0;  ///< sums
    int bins_ = 0;
    int bins_with_share_ = 0;  ///< point targets in the water have none
};

/// The facts of an object from the values in `box`: its mean range, visible share and contrast, and
/// the contrast of its shadow in `shadow`. `range_m` is the range of each bin.
SeenFacts seen_in_records(const RecordValues& values, std::uint16_t id, const BinBox& box,
                          const BinBox& shadow, std::span<const double> range_m,
                          std::span<const std::uint8_t> is_background);

/// The bins in `within` that show the shadow of an object; empty for none.
BinBox shadow_box(const RecordValues& values, std::uint16_t id, const BinBox& within);

}  // namespace sonarsim
