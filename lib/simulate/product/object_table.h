#pragma once

#include <Eigen/Geometry>
#include <cstring>

#include "simulate/labels/labels.h"
#include "simulate/ping/sonar.h"
#include "simulate/product/contrast.h"
#include "simulate/product/picture.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

/// An object in a ping that is no background. Its bins are those in which its echo is the largest.
struct ObjectInPing {
    std::uint32_t id = 0;                 ///< as in PingLabels
    int range_first = 0, range_last = 0;  ///< inclusive bounds of its bins
    int beam_first = 0, beam_last = 0;
    std::uint64_t bins = 0;
    double level = 0.0;                        ///< mean intensity of its bins
    std::optional<double> surrounding_level;   ///< mean intensity of the other bins around them
    double range_m = 0.0;                      ///< mean of its bins
    std::optional<double> azimuth_rad;         ///< mean of its bins, for a fan
    Eigen::AlignedBox3f box_sensor_m;          ///< box around its visible surface, sensor frame
    std::optional<double> contrast_db;         ///< level over its surroundings, contrast_db()
    BinBox shadow;                             ///< box of its bins of PingLabels::object_shadow
    std::uint64_t shadow_bins = 0;             ///< number of these bins
    std::optional<double> shadow_contrast_db;  ///< the same for its shadow
    PixelBox shadow_in_fan;                    ///< empty: no fan, or no pixel in it
};

/// 1 for the ids of background, and for those that no object has; indexed by all ids of 16 bits.
std::vector<std::uint8_t> background_ids(const SceneObjects& objects);

/// 1 for the ids whose masks include the shadow, 0 for all others of 16 bits.
std::vector<std::uint8_t> shadow_ids(const SceneObjects& objects);

/// The objects, shadows and levels of a ping. It refers to `labels` and `ping`.
LevelMap level_map(const Sonar& sonar, const PingLabels& labels, const Ping& ping);

/// The objects in a ping, sorted by id. `labels` gives the object of each bin, `ping` the levels.
/// `fan_boxes` are FanBins::boxes; empty: no fan. An object's surroundings: the box of its bins
/// and half its size, at least two bins, on each side.
std::vector<ObjectInPing> visible_objects(const Sonar& sonar, const SceneObjects& objects,
                                          const TracedPing& traced, const PingLabels& labels,
                                          const Ping& ping, std::span<const PixelBox> fan_boxes);

/// The pixels of one object in a picture: a bounding box and runs.
struct ObjectMask {
    std::uint32_t id = 0;
    int left = 0, right = 0;  ///< columns [left, right)
    int top = 0, bottom = 0;  ///< rows [top, bottom)
    std::uint64_t area = 0;   ///< pixels
    /// Lengths of runs, alternately outside and inside the object, column after column from the
    /// top. They add up to all pixels; only the first may be 0.
    std::vector<std::uint32_t> runs;
};

/// The end of the run of equal ids that begins at a place.
inline std::size_t end_of_run(std::span<const std::uint16_t> ids, std::size_t from) {
    constexpr std::size_t at_once = 4;
    const std::uint64_t same = ids[from] * std::uint64_t{0x0001000100010001};
    std::size_t to = from + 1;
    for (std::uint64_t next; to + at_once <= ids.size(); to += at_once) {
        std::memcpy(&next, &ids[to], sizeof next);
        if (next != same) break;
    }
    while (to < ids.size() && ids[to] == ids[from])
        ++to;
    return to;
}

/// The masks of a picture's objects, sorted by id. `ids` holds the columns one after the other,
/// each `height` pixels from the top; 0 means no object.
std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height);

}  // namespace sonarsim
