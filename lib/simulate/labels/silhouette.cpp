#include "simulate/labels/silhouette.h"

#include <Eigen/Core>
#include <array>
#include <iterator>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;

// The shares of its hull that a shape covers at least. In the median, people draw tyres, bottles,
// cans and walls to 0.92 to 0.97 of it, hooks, chains and valves to 0.55 (masks of the Marine
// Debris FLS set, Singh and Valdenegro-Toro 2021). A ring with a third of its hole open has 0.4.
constexpr double min_closed_share = 0.7;
constexpr double min_open_share = 0.4;  ///< if the border of the picture cuts it open

/// A line of bins in the plane of the picture, in bins: bin i is at origin + i * along.
struct PictureLine {
    Eigen::Vector2d origin, along;

    Eigen::Vector2d at(int bin) const { return origin + bin * along; }
};

PictureLine picture_line(const MaskFrame& frame, int line) {
    if (frame.beam_rad == 0.0) return {Eigen::Vector2d(line, 0.0), Eigen::Vector2d(0.0, 1.0)};
    const SinCos angle = sincos((line + 0.5 - 0.5 * frame.lines) * frame.beam_rad);
    const Eigen::Vector2d along(angle.sin, angle.cos);
    return {(frame.first_bin + 0.5) * along, along};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

using Points = std::vector<Eigen::Vector2d>;

/// The corners of the convex hull, anticlockwise (Andrew's monotone chain).
Points convex_hull(Points points) {
    std::ranges::sort(points, [](const auto& a, const auto& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    Points hull;
    const auto add = [&](const Eigen::Vector2d& point, std::size_t first) {
        while (hull.size() >= first + 2 &&
               cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const Eigen::Vector2d& point : points)
        add(point, 0);
    hull.pop_back();
    const std::size_t first = hull.size();
    for (auto point = points.rbegin(); point != points.rend(); ++point)
        add(*point, first);
    hull.pop_back();
    return hull;
}

/// The bins of a line within a hull, first to last; none if last < first.
std::pair<int, int> bins_within(const Points& hull, const PictureLine& line, int first, int last) {
    double from = first;
    double to = last;
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const Eigen::Vector2d edge = hull[(k + 1) % hull.size()] - hull[k];
        const double inside = cross(edge, line.origin - hull[k]);
        const double change = cross(edge, line.along);
        if (change > 0.0) from = std::max(from, -inside / change);
        if (change < 0.0) to = std::min(to, -inside / change);
        if (change == 0.0 && inside < 0.0) return {0, -1};
    }
    constexpr double rounding = 1e-6;
    return {static_cast<int>(std::ceil(from - rounding)),
            static_cast<int>(std::floor(to + rounding))};
}

/// True if one side of the picture cuts a shape in two places or more: it cuts an open side off.
/// A wall meets two sides, and what lies behind it is not part of it.
bool is_cut_open(const MaskFrame& frame, const MaskWindow& shape, std::span<const int> piece) {
    std::array<std::vector<int>, 4> places;  // along each side
    for (const int at : piece) {
        const int line = shape.line + at / shape.bins;
        const int bin = shape.bin + at % shape.bins;
        if (!frame.full_turn && line == 0) places[0].push_back(bin);
        if (!frame.full_turn && line + 1 == frame.lines) places[1].push_back(bin);
        if (bin == 0) places[2].push_back(line);
        if (bin + 1 == frame.bins) places[3].push_back(line);
    }
    if (std::ranges::count_if(places, [](const auto& side) { return !side.empty(); }) != 1)
        return false;
    std::vector<int>& side = *std::ranges::max_element(places, {}, &std::vector<int>::size);
    std::ranges::sort(side);
    return std::ranges::adjacent_find(side, [](int a, int b) { return b > a + 2; }) != side.end();
}

/// Fills the hull of the bins `piece` of a shape, if they cover enough of it.
bool fill_hull(const MaskFrame& frame, MaskWindow& shape, std::vector<int> piece) {
    const double min_share = is_cut_open(frame, shape, piece) ? min_open_share : min_closed_share;
    std::ranges::sort(piece);
    Points ends;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const int line = piece[k] / shape.bins;
        const bool is_end = k == 0 || k + 1 == piece.size() || piece[k - 1] / shape.bins != line ||
                            piece[k + 1] / shape.bins != line;
        if (is_end)
            ends.push_back(
                picture_line(frame, shape.line + line).at(shape.bin + piece[k] % shape.bins));
    }
    const Points hull = convex_hull(std::move(ends));
    if (hull.size() < 3) return true;
    std::vector<int> filled;
    for (int line = piece.front() / shape.bins; line <= piece.back() / shape.bins; ++line) {
        const auto [from, to] = bins_within(hull, picture_line(frame, shape.line + line), shape.bin,
                                            shape.bin + shape.bins - 1);
        for (int bin = from; bin <= to; ++bin)
            filled.push_back(line * shape.bins + bin - shape.bin);
    }
    if (static_cast<double>(piece.size()) < min_share * static_cast<double>(filled.size()))
        return false;
    for (const int at : filled)
        shape.values[at] = 1.0F;
    return true;
}

/// Fills the convex hull of a shape of values other than 0 with ones, as a person draws around a
/// compact body of which a part is missing, if the shape covers most of it; else that of each of
/// its pieces for which this holds. In a fan, lines are straight in the plane of the picture.
void fill_hulls(const MaskFrame& frame, MaskWindow& shape) {
    constexpr float whole = 2.0F;
    constexpr float done = 1.0F;
    std::vector<int> all;
    for (int k = 0; k < std::ssize(shape.values); ++k) {
        if (shape.values[k] == 0.0F) continue;
        shape.values[k] = whole;
        all.push_back(k);
    }
    if (all.empty() || fill_hull(frame, shape, all)) return;
    for (const int k : all) {
        if (shape.values[k] == whole) fill_hull(frame, shape, shape.flood(k, done, true));
    }
}

CellReach closing_reach(const ResolutionCell& cell) {
    return CellReach({std::max(cell.range_bins, 2.0), std::max(cell.beams, 2.0)});
}

/// Replaces each value by 1 if the sum of those within reach is at least `least`, else by 0.
void sum_and_compare(MaskWindow& window, const CellReach& reach, float min_size) {
    window.sum_within(reach);
    for (float& value : window.values)
        value = value >= min_size ? 1.0F : 0.0F;
}

/// Closes the gaps of a shape of ones, fills its holes and keeps the pieces with keep(bins).
template <class Keep>
void tidy(MaskWindow& shape, const CellReach& reach, Keep keep) {
    sum_and_compare(shape, reach, 1.0F);
    sum_and_compare(shape, reach, reach.count());
    constexpr float outside = 2.0F;
    constexpr float kept = 3.0F;
    shape.flood(0, outside, false);
    for (float& value : shape.values)
        value = value == outside ? 0.0F : 1.0F;
    for (int k = 0; k < std::ssize(shape.values); ++k) {
        if (shape.values[k] != 1.0F) continue;
        const std::vector<int> piece = shape.flood(k, kept, true);
        if (keep(piece)) continue;
        for (const int at : piece)
            shape.values[at] = 0.0F;
    }
}

}  // namespace

Ids find_bodies(const ExpectedBins& ping, std::span<const float> noise, float min_ratio) {
    const ResolutionCell& cell = ping.frame.cell;
    const CellReach reach(cell);
    const auto scale = static_cast<float>(cell.range_bins * cell.beams) / reach.count();
    Ids out(ping.object.size());
    for (MaskWindow& window : windows_of(ping.frame, reach, ping.object)) {
        window.for_each(ping.frame, [&](float& more, std::size_t k) {
            if (ping.object[k] != window.id) return;
            const float rest = std::max(ping.whole[k] - ping.echo[k], 0.0F);
            more = scale * (ping.echo[k] - min_ratio * rest);
        });
        window.sum_within(reach);
        window.for_each(ping.frame, [&](float more, std::size_t k) {
            const float bare = noise.empty() ? 0.0F : noise[k % ping.frame.bins];
            if (ping.object[k] == window.id && more >= min_ratio * bare) out[k] = window.id;
        });
    }
    return out;
}

void add_bright(const MaskFrame& frame, const Ids& bright, Ids& bodies) {
    const CellReach reach({3.0, frame.lines > 1 ? 3.0 : 1.0});
    Ids both = bodies;
    for (std::size_t k = 0; k < both.size(); ++k) {
        if (both[k] == 0) both[k] = bright[k];
    }
    for (MaskWindow& shape : windows_of(frame, reach, both)) {
        sum_and_compare(shape, reach, reach.count());
        sum_and_compare(shape, reach, 1.0F);
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value != 0.0F && both[k] == shape.id) bodies[k] = shape.id;
        });
    }
}

Ids outlined(const MaskFrame& frame, const Ids& ids) {
    const CellReach half_cell(frame.cell);
    const CellReach reach = closing_reach(frame.cell);
    Ids out(ids.size());
    const CellReach margin(
        {2.0 * (reach.bins + half_cell.bins), 2.0 * (reach.lines + half_cell.lines)});
    for (MaskWindow& shape : windows_of(frame, margin, ids)) {
        sum_and_compare(shape, half_cell, 1.0F);
        tidy(shape, reach, [&](const std::vector<int>& piece) {
            return static_cast<float>(piece.size()) >= half_cell.count();
        });
        fill_hulls(frame, shape);
        shape.for_each(frame, [&](float value, std::size_t k) {
            const bool is_free = out[k] == 0 && (ids[k] == 0 || ids[k] == shape.id);
            if (value != 0.0F && is_free) out[k] = shape.id;
        });
    }
    return out;
}

void drop_mirror_images(const MaskFrame& frame, std::span<const std::uint16_t> visible, Ids& ids) {
    constexpr float found = 2.0F;
    for (MaskWindow& shape : windows_of(frame, CellReach({}), ids)) {
        MaskWindow kept = shape;
        kept.for_each(frame, [&](float& value, std::size_t k) {
            value = visible[k] == shape.id ? 1.0F : 0.0F;
        });
        for (int k = 0; k < std::ssize(shape.values); ++k) {
            if (shape.values[k] == 1.0F && kept.values[k] == 1.0F) shape.flood(k, found, true);
        }
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value == 1.0F) ids[k] = 0;
        });
    }
}

Ids with_shadows(const MaskFrame& frame, const Ids& ids, const Ids& shadow,
                 std::span<const std::uint8_t> has_shadow) {
    const CellReach reach = closing_reach(frame.cell);
    const float min_size = CellReach(frame.cell).count();
    Ids both = ids;
    for (std::size_t k = 0; k < both.size(); ++k) {
        if (both[k] == 0 && has_shadow[shadow[k]] != 0) both[k] = shadow[k];
    }
    Ids out = ids;
    for (MaskWindow& shape : windows_of(frame, reach, both)) {
        if (has_shadow[shape.id] == 0) continue;
        std::vector<char> has_object(shape.lines);
        shape.for_each(frame, [&](const float& value, std::size_t k) {
            if (ids[k] == shape.id) has_object[(&value - shape.values.data()) / shape.bins] = 1;
        });
        tidy(shape, reach, [&](const std::vector<int>& piece) {
            return static_cast<float>(piece.size()) >= min_size &&
                   std::ranges::any_of(piece,
                                       [&](int k) { return has_object[k / shape.bins] != 0; });
        });
        shape.for_each(frame, [&](float value, std::size_t k) {
            if (value != 0.0F && out[k] == 0) out[k] = shape.id;
        });
    }
    return out;
}

}  // namespace sonarsim
