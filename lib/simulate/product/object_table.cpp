#include "simulate/product/object_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace sonarsim {

namespace {

struct BinTotals {
    double level = 0.0;
    double range_m = 0.0;
    double azimuth_rad = 0.0;
};

/// Adds the bins [from, to) of beam j.
void add_bins(ObjectInPing& visible, int from, int to, int j) {
    if (visible.bins == 0) {
        visible.range_first = from;
        visible.beam_first = j;
    }
    visible.range_first = std::min(visible.range_first, from);
    visible.range_last = std::max(visible.range_last, to - 1);
    visible.beam_last = j;
    visible.bins += static_cast<std::uint64_t>(to - from);
}

/// Adds the bins [from, to) of a beam one by one, since the order decides the last digits. The
/// three sums are independent, so that they take the time of one.
void add_to_totals(const Ping& ping, int beam, int from, int to, std::span<const double> ranges_m,
                   double azimuth_rad, BinTotals& totals) {
    BinTotals sum = totals;
    for (int i = from; i < to; ++i) {
        sum.level += ping.at(i, beam);
        sum.range_m += ranges_m[i];
        sum.azimuth_rad += azimuth_rad;
    }
    totals = sum;
}

/// Calls visit(id, from, to) for the runs of bins [from, to) of a beam that have an id.
template <class Visit>
void for_each_run(std::span<const std::uint16_t> ids, Visit visit) {
    for (std::size_t from = 0, to = 0; from < ids.size(); from = to) {
        to = end_of_run(ids, from);
        if (ids[from] != 0) visit(ids[from], static_cast<int>(from), static_cast<int>(to));
    }
}

bool has_azimuths(const Sonar& sonar, const PingLabels& labels) {
    return std::ssize(sonar.azimuth_edges_rad) == labels.beams + 1;
}

BinBox bins_of(const ObjectInPing& visible) {
    return {visible.beam_first, visible.beam_last, visible.range_first, visible.range_last};
}

/// The mean level around an object; nothing if all bins there are its own.
std::optional<double> level_around(const ObjectInPing& visible, const LevelMap& map) {
    const auto id = static_cast<std::uint16_t>(visible.id);
    const BinBox box = over_seam(map, map.object, id, bins_of(visible));
    const auto margin_of = [](int first, int last) { return std::max(2, (last - first + 1) / 2); };
    const int rows = margin_of(box.first_bin, box.last_bin);
    const int columns = margin_of(box.first_line, box.last_line);
    double sum = 0.0;
    std::uint64_t bins = 0;
    const int last_row = std::min(box.last_bin + rows, map.bins - 1);
    int first_column = box.first_line - columns;
    if (!map.full_turn) first_column = std::max(first_column, 0);
    const int end = map.full_turn ? first_column + map.lines : map.lines;
    for (int j = first_column; j < std::min(box.last_line + columns + 1, end); ++j) {
        const std::size_t begin = static_cast<std::size_t>(map.line_at(j)) * map.bins;
        for (int i = std::max(box.first_bin - rows, 0); i <= last_row; ++i) {
            if (map.object[begin + i] == id) continue;
            sum += map.level_at(map.line_at(j), i);
            ++bins;
        }
    }
    if (bins == 0) return std::nullopt;
    return sum / static_cast<double>(bins);
}

/// Extends a box by the line p + t e, |t| <= 1, where its range lies between two.
void extend_by_line(const Eigen::Vector3f& p, const Eigen::Vector3f& e, float near_m, float far_m,
                    Eigen::AlignedBox3f& box) {
    // The range is r at the roots of e^2 t^2 + 2 p.e t + p^2 - r^2.
    const auto crossings = [&](float r) {
        const float e2 = std::max(e.squaredNorm(), std::numeric_limits<float>::min());
        const float middle = -p.dot(e) / e2;
        const float half = std::sqrt(middle * middle - (p.squaredNorm() - r * r) / e2);
        return std::pair(middle - half, middle + half);  // NaN if there is none
    };
    const auto [enters, leaves] = crossings(far_m);
    float from = std::max(enters, -1.0F);
    float to = std::min(leaves, 1.0F);
    const auto [ends, begins] = crossings(near_m);
    if (ends <= from && from < begins) from = begins;
    if (ends < to && to <= begins) to = ends;
    if (!(from <= to && enters <= leaves)) return;
    box.extend(p + from * e);
    box.extend(p + to * e);
}

/// The box around each object's visible surface, sensor frame. Corners of samples may be hidden.
std::vector<Eigen::AlignedBox3f> visible_boxes(const SceneObjects& objects, const View& view,
                                               const TracedPing& traced) {
    std::vector<Eigen::AlignedBox3f> boxes(objects.objects.size());
    for_each_received(traced, [&](const Sample& sample) {
        const std::uint32_t object = objects.object_of(sample.instance);
        if (objects.is_background(object)) return;
        for (const Eigen::Vector3f& edge : {sample.edge_u, sample.edge_v}) {
            extend_by_line(sample.middle(), edge, static_cast<float>(view.range_min_m),
                           static_cast<float>(view.range_max_m), boxes[object]);
        }
    });
    return boxes;
}

/// Finds the shadows of the objects, from the first bin of each on: nearer ones lie behind a part
/// of it that another surface outshines. `all` is indexed by object.
void add_shadows(const PingLabels& labels, std::span<const PixelBox> fan_boxes,
                 std::vector<ObjectInPing>& all) {
    if (labels.object_shadow.empty()) return;
    for (int j = 0; j < labels.beams; ++j) {
        const std::size_t begin = static_cast<std::size_t>(j) * labels.range_bins;
        const auto own = std::span(labels.object_shadow).subspan(begin, labels.range_bins);
        for_each_run(own, [&](std::uint16_t id, int first, int to) {
            ObjectInPing& object = all[id - 1];
            const int from = std::max(first, object.range_first);
            if (from >= to) return;
            object.shadow.extend(j, from);
            object.shadow.extend(j, to - 1);
            object.shadow_bins += static_cast<std::uint64_t>(to - from);
            if (fan_boxes.empty()) return;
            PixelBox in_fan = object.shadow_in_fan;
            for (int i = from; i < to; ++i)
                in_fan = joined(in_fan, fan_boxes[begin + i]);
            object.shadow_in_fan = in_fan;
        });
    }
}

struct GrowingMask {
    ObjectMask mask;
    std::size_t end = 0;  ///< end of its last run

    void add(std::size_t from, std::size_t to, int height) {
        const auto h = static_cast<std::size_t>(height);
        const int left = static_cast<int>(from / h);
        const int right = static_cast<int>((to - 1) / h) + 1;
        const bool spans = right - left > 1;
        const int top = spans ? 0 : static_cast<int>(from % h);
        const int bottom = spans ? height : static_cast<int>((to - 1) % h) + 1;
        if (mask.area == 0) {
            mask.left = left;
            mask.top = top;
        }
        mask.right = right;
        mask.top = std::min(mask.top, top);
        mask.bottom = std::max(mask.bottom, bottom);
        mask.area += to - from;
        mask.runs.push_back(static_cast<std::uint32_t>(from - end));
        mask.runs.push_back(static_cast<std::uint32_t>(to - from));
        end = to;
    }
};

}  // namespace

std::vector<std::uint8_t> background_ids(const SceneObjects& objects) {
    std::vector<std::uint8_t> is_background(std::size_t{1} << 16, 1);
    for (std::uint32_t k = 0; k < objects.objects.size(); ++k)
        is_background[k + 1] = objects.is_background(k) ? 1 : 0;
    return is_background;
}

std::vector<std::uint8_t> shadow_ids(const SceneObjects& objects) {
    std::vector<std::uint8_t> has_shadow(std::size_t{1} << 16, 0);
    for (std::uint32_t k = 0; k < objects.objects.size(); ++k)
        has_shadow[k + 1] = objects.has_shadow(k) ? 1 : 0;
    return has_shadow;
}

LevelMap level_map(const Sonar& sonar, const PingLabels& labels, const Ping& ping) {
    return {.lines = labels.beams,
            .bins = labels.range_bins,
            .object = labels.facts(),
            .shadow = labels.object_shadow,
            .level = ping.intensity,
            .full_turn = has_azimuths(sonar, labels) && is_full_turn(sonar.settings.view),
            .levels_by_bin = true};
}

std::vector<ObjectInPing> visible_objects(const Sonar& sonar, const SceneObjects& objects,
                                          const TracedPing& traced, const PingLabels& labels,
                                          const Ping& ping, std::span<const PixelBox> fan_boxes) {
    std::vector<ObjectInPing> all(objects.objects.size());
    std::vector<BinTotals> totals(all.size());
    const std::vector<std::uint8_t> is_background = background_ids(objects);
    const bool fan = has_azimuths(sonar, labels);
    const LevelMap map = level_map(sonar, labels, ping);
    const auto azimuth_of = [&](int beam) {
        return 0.5 * (sonar.azimuth_edges_rad[beam] + sonar.azimuth_edges_rad[beam + 1]);
    };
    std::vector<double> ranges_m(labels.range_bins);
    for (int i = 0; i < labels.range_bins; ++i)
        ranges_m[i] = sonar.middle_m(i);
    for (int j = 0; j < labels.beams; ++j) {
        const std::size_t begin = static_cast<std::size_t>(j) * labels.range_bins;
        const double azimuth_rad = fan ? azimuth_of(j) : 0.0;
        // In a full turn, the azimuth nearest to that of the object's first beam.
        const auto near_first = [&](int first) {
            if (!map.full_turn) return azimuth_rad;
            const double turn = 2.0 * pi;
            return azimuth_rad + turn * std::round((azimuth_of(first) - azimuth_rad) / turn);
        };
        const auto own = std::span(labels.facts()).subspan(begin, labels.range_bins);
        for_each_run(own, [&](std::uint16_t id, int from, int to) {
            if (is_background[id] != 0) return;
            add_bins(all[id - 1], from, to, j);
            add_to_totals(ping, j, from, to, ranges_m, near_first(all[id - 1].beam_first),
                          totals[id - 1]);
        });
    }
    add_shadows(labels, fan_boxes, all);
    const std::vector<Eigen::AlignedBox3f> boxes =
        visible_boxes(objects, sonar.settings.view, traced);
    std::vector<ObjectInPing> visible;
    for (std::size_t k = 0; k < all.size(); ++k) {
        ObjectInPing& object = all[k];
        if (object.bins == 0) continue;
        const auto bins = static_cast<double>(object.bins);
        object.id = static_cast<std::uint32_t>(k + 1);
        object.level = totals[k].level / bins;
        object.range_m = totals[k].range_m / bins;
        if (fan) object.azimuth_rad = totals[k].azimuth_rad / bins;
        if (map.full_turn) object.azimuth_rad = std::remainder(*object.azimuth_rad, 2.0 * pi);
        object.surrounding_level = level_around(object, map);
        object.box_sensor_m = boxes[k];
        const auto id = static_cast<std::uint16_t>(object.id);
        object.contrast_db = contrast_db(map, map.object, id, bins_of(object), is_background);
        if (!object.shadow.is_empty()) {
            object.shadow_contrast_db =
                contrast_db(map, map.shadow, id, object.shadow, is_background);
        }
        visible.push_back(object);
    }
    return visible;
}

std::vector<ObjectMask> object_masks(std::span<const std::uint16_t> ids, int height) {
    std::vector<GrowingMask> growing;
    std::vector<std::uint32_t> place_of_id;  // 1 + index into `growing`
    for (std::size_t from = 0, to = 0; from < ids.size(); from = to) {
        const std::uint16_t id = ids[from];
        to = end_of_run(ids, from);
        if (id == 0) continue;
        if (place_of_id.size() <= id) place_of_id.resize(id + std::size_t{1}, 0);
        if (place_of_id[id] == 0) {
            growing.emplace_back().mask.id = id;
            place_of_id[id] = static_cast<std::uint32_t>(growing.size());
        }
        growing[place_of_id[id] - 1].add(from, to, height);
    }
    std::vector<ObjectMask> masks;
    masks.reserve(growing.size());
    for (const std::uint32_t place : place_of_id) {
        if (place == 0) continue;
        GrowingMask& one = growing[place - 1];
        if (one.end < ids.size())
            one.mask.runs.push_back(static_cast<std::uint32_t>(ids.size() - one.end));
        masks.push_back(std::move(one.mask));
    }
    return masks;
}

}  // namespace sonarsim
