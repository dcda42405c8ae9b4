#include "product/object_table.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// A running sum over the bins of an object.
struct BinTotals {
    double level = 0.0;
    double range_m = 0.0;
    double azimuth_rad = 0.0;
};

std::uint16_t object_at(const PingLabels& labels, int range_bin, int beam) {
    return labels.object[static_cast<std::size_t>(beam) * labels.range_bins + range_bin];
}

void add_bin(SeenObject& seen, int i, int j) {
    if (seen.bins == 0) {
        seen.range_first = seen.range_last = i;
        seen.beam_first = seen.beam_last = j;
    }
    seen.range_first = std::min(seen.range_first, i);
    seen.range_last = std::max(seen.range_last, i);
    seen.beam_first = std::min(seen.beam_first, j);
    seen.beam_last = std::max(seen.beam_last, j);
    ++seen.bins;
}

/// The levels of a ping in the order of its labels, [beams, range bins].
std::vector<float> levels_by_beam(const Ping& ping) {
    constexpr int tile = 16;
    std::vector<float> levels(ping.intensity.size());
    for (int i0 = 0; i0 < ping.range_bins; i0 += tile) {
        for (int j = 0; j < ping.beams; ++j) {
            float* const beam = levels.data() + static_cast<std::size_t>(j) * ping.range_bins;
            for (int i = i0; i < std::min(i0 + tile, ping.range_bins); ++i)
                beam[i] = ping.at(i, j);
        }
    }
    return levels;
}

/// The mean level around an object; nothing if all bins there are its own.
std::optional<double> level_around(const SeenObject& seen, const PingLabels& labels,
                                   const std::vector<float>& levels) {
    const auto margin_of = [](int first, int last) { return std::max(2, (last - first + 1) / 2); };
    const int rows = margin_of(seen.range_first, seen.range_last);
    const int columns = margin_of(seen.beam_first, seen.beam_last);
    double sum = 0.0;
    std::uint64_t bins = 0;
    const int last_row = std::min(seen.range_last + rows, labels.range_bins - 1);
    const int last_column = std::min(seen.beam_last + columns, labels.beams - 1);
    for (int j = std::max(seen.beam_first - columns, 0); j <= last_column; ++j) {
        for (int i = std::max(seen.range_first - rows, 0); i <= last_row; ++i) {
            if (object_at(labels, i, j) == seen.id) continue;
            sum += levels[static_cast<std::size_t>(j) * labels.range_bins + i];
            ++bins;
        }
    }
    if (bins == 0) return std::nullopt;
    return sum / static_cast<double>(bins);
}

/// The bounding box of each object's visible footprints.
std::vector<Eigen::AlignedBox3f> seen_boxes(const SceneObjects& objects, const TracedPing& traced) {
    std::vector<Eigen::AlignedBox3f> boxes(objects.objects.size());
    const auto extend = [&](const Sample& sample) {
        const Eigen::Vector3f reach = sample.edge_u.cwiseAbs() + sample.edge_v.cwiseAbs();
        Eigen::AlignedBox3f& box = boxes[objects.object_of(sample.instance)];
        box.extend(sample.position - reach);
        box.extend(sample.position + reach);
    };
    std::ranges::for_each(traced.samples.items, extend);
    std::ranges::for_each(traced.outside_sector, extend);
    return boxes;
}

/// Finds the shadows of objects, by the index of each.
void add_shadows(const PingLabels& labels, std::span<const PixelBox> fan_boxes,
                 std::vector<SeenObject>& all) {
    if (labels.object_shadow.empty()) return;
    for (int j = 0; j < labels.beams; ++j) {
        const std::size_t begin = static_cast<std::size_t>(j) * labels.range_bins;
        // Most beams have no shadow; this loop is vectorised.
        std::uint16_t any = 0;
        for (int i = 0; i < labels.range_bins; ++i)
            any |= labels.object_shadow[begin + i];
        for (int i = 0; any != 0 && i < labels.range_bins; ++i) {
            const std::size_t at = begin + i;
            const std::uint16_t id = labels.object_shadow[at];
            if (id == 0) continue;
            SeenObject& object = all[id - 1];
            object.shadow.extend(j, i);
            ++object.shadow_bins;
            if (!fan_boxes.empty())
                object.shadow_in_fan = joined(object.shadow_in_fan, fan_boxes[at]);
        }
    }
}

/// Compares objects and their shadows with what is around them.
class Contrasts {
  public:
    Contrasts(const SceneObjects& objects, const PingLabels& labels, std::span<const float> levels)
        : labels_(labels),
          map_{labels.beams, labels.range_bins, labels.object, labels.object_shadow, levels} {
        is_background_.push_back(1);
        for (std::uint32_t k = 0; k < objects.objects.size(); ++k)
            is_background_.push_back(objects.is_background(k) ? 1 : 0);
    }

    void add_to(SeenObject& seen) const {
        if (is_background_[seen.id] != 0) return;
        const auto id = static_cast<std::uint16_t>(seen.id);
        const BinBox box{seen.beam_first, seen.beam_last, seen.range_first, seen.range_last};
        seen.contrast_db = contrast_db(map_, map_.object, id, box, is_background_);
        if (!seen.shadow.is_empty()) {
            seen.shadow_contrast_db =
                contrast_db(map_, map_.shadow, id, seen.shadow, is_background_);
        }
        if (labels_.visible_share.empty()) return;
        const float share = labels_.visible_share[seen.id - 1];
        if (std::isfinite(share)) seen.visible_share = share;
    }

  private:
    const PingLabels& labels_;
    LevelMap map_;
    std::vector<std::uint8_t> is_background_;  ///< indexed by id
};

}  // namespace

ObjectFacts facts_of(const SeenObject& seen, const SceneObjects& objects, std::uint64_t pixels) {
    return {objects.is_background(seen.id - 1), pixels, seen.visible_share, seen.contrast_db,
            seen.shadow_contrast_db};
}

std::vector<SeenObject> seen_objects(const Sonar& sonar, const SceneObjects& objects,
                                     const TracedPing& traced, const PingLabels& labels,
                                     const Ping& ping, std::span<const PixelBox> fan_boxes) {
    std::vector<SeenObject> all(objects.objects.size());
    std::vector<BinTotals> totals(all.size());
    const std::vector<float> levels = levels_by_beam(ping);
    const bool fan = std::ssize(sonar.azimuth_edges_rad) == labels.beams + 1;
    const auto middle = [](const std::vector<double>& edges, int k) {
        return 0.5 * (edges[k] + edges[k + 1]);
    };
    for (int j = 0; j < labels.beams; ++j) {
        for (int i = 0; i < labels.range_bins; ++i) {
            const std::uint16_t id = object_at(labels, i, j);
            if (id == 0) continue;
            add_bin(all[id - 1], i, j);
            BinTotals& total = totals[id - 1];
            total.level += levels[static_cast<std::size_t>(j) * labels.range_bins + i];
            total.range_m += middle(sonar.range_edges_m, i);
            if (fan) total.azimuth_rad += middle(sonar.azimuth_edges_rad, j);
        }
    }
    add_shadows(labels, fan_boxes, all);
    const Contrasts contrasts(objects, labels, levels);
    const std::vector<Eigen::AlignedBox3f> boxes = seen_boxes(objects, traced);
    std::vector<SeenObject> seen;
    for (std::size_t k = 0; k < all.size(); ++k) {
        SeenObject& object = all[k];
        if (object.bins == 0) continue;
        const auto bins = static_cast<double>(object.bins);
        object.id = static_cast<std::uint32_t>(k + 1);
        object.level = totals[k].level / bins;
        object.range_m = totals[k].range_m / bins;
        if (fan) object.azimuth_rad = totals[k].azimuth_rad / bins;
        object.surrounding_level = level_around(object, labels, levels);
        object.box_sensor_m = boxes[k];
        contrasts.add_to(object);
        seen.push_back(object);
    }
    return seen;
}

}  // namespace sonarsim
