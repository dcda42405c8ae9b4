#include "simulate/product/contrast.h"

#include <algorithm>
#include <map>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// The leading bits of a positive float index a histogram with cells at most 3 % wide.
constexpr int dropped_bits = 18;
constexpr std::size_t cells = 0x80000000U >> dropped_bits;

/// The marked bins of one range, and their surroundings.
struct RangeLevels {
    int first = 0, last = -1;  ///< lines
    int count = 0, count_around = 0;
    double level = 0.0, level_around = 0.0;

    int width() const { return std::max(last - first + 1, 2); }
};

/// The index of the first bin of a box on a line.
std::size_t first_bin_of(const LevelMap& map, int line, const BinBox& box) {
    return static_cast<std::size_t>(map.line_at(line)) * map.bins + box.first_bin;
}

std::vector<RangeLevels> marked_levels(const LevelMap& map, std::span<const std::uint16_t> marks,
                                       std::uint16_t id, const BinBox& box) {
    std::vector<RangeLevels> ranges(static_cast<std::size_t>(box.last_bin - box.first_bin) + 1);
    for (int line = box.first_line; line <= box.last_line; ++line) {
        const std::size_t begin = first_bin_of(map, line, box);
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            if (marks[begin + k] != id) continue;
            RangeLevels& range = ranges[k];
            if (range.count++ == 0) range.first = line;
            range.last = line;
            range.level += map.level_at(map.line_at(line), box.first_bin + static_cast<int>(k));
        }
    }
    return ranges;
}

void add_surroundings(const LevelMap& map, const BinBox& box,
                      std::span<const std::uint8_t> is_background,
                      std::vector<RangeLevels>& ranges) {
    int widest = 0;
    for (const RangeLevels& range : ranges)
        widest = std::max(widest, range.width());
    int first = box.first_line - widest;
    if (!map.full_turn) first = std::max(first, 0);
    const int end = map.full_turn ? first + map.lines : map.lines;
    for (int line = first; line < std::min(box.last_line + widest + 1, end); ++line) {
        const std::size_t begin = first_bin_of(map, line, box);
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            RangeLevels& range = ranges[k];
            const int width = range.width();
            if (range.count == 0 || line < range.first - width || line > range.last + width)
                continue;
            const std::uint16_t object = map.object[begin + k];
            const bool is_bare = object == 0 || is_background[object] != 0;
            if (!is_bare || (!map.shadow.empty() && map.shadow[begin + k] != 0)) continue;
            range.level_around +=
                map.level_at(map.line_at(line), box.first_bin + static_cast<int>(k));
            ++range.count_around;
        }
    }
}

double decibel_of(double ratio) {
    constexpr double limit_db = 100.0;
    constexpr double min_ratio = 1e-10;
    if (!(ratio > min_ratio)) return -limit_db;
    if (!(ratio < 1.0 / min_ratio)) return limit_db;
    return db_of_e * natural_log(static_cast<float>(ratio));
}

}  // namespace

Gain::Gain() : counts_(cells, 0) {}

void Gain::add(std::span<const float> intensity) {
    for (const float value : intensity) {
        if (value > 0.0F) ++counts_[std::bit_cast<std::uint32_t>(value) >> dropped_bits];
    }
}

double Gain::white() const {
    std::uint64_t occupied = 0;
    for (const std::uint64_t count : counts_)
        occupied += count;
    if (occupied == 0) return 1.0;
    std::uint64_t above = 0;
    for (std::size_t cell = cells; cell-- > 0;) {
        above += counts_[cell];
        const auto upper = static_cast<std::uint32_t>(cell + 1) << dropped_bits;
        if (100 * above >= occupied) return std::bit_cast<float>(upper);
    }
    return 1.0;
}

float shade(float intensity, float white) {
    return std::sqrt(std::clamp(intensity / white, 0.0F, 1.0F));
}

std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale) {
    const float scale = static_cast<float>(65535.0 / full_scale);
    std::vector<std::uint16_t> grey(intensity.size());
    for (std::size_t i = 0; i < grey.size(); ++i) {
        const float value = std::min(65535.0F, std::max(0.0F, intensity[i] * scale));
        grey[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(value + 0.5F));
    }
    return grey;
}

void BinBox::extend(int line, int bin) {
    if (is_empty()) *this = {line, line, bin, bin};
    first_line = std::min(first_line, line);
    last_line = std::max(last_line, line);
    first_bin = std::min(first_bin, bin);
    last_bin = std::max(last_bin, bin);
}

BinBox over_seam(const LevelMap& map, std::span<const std::uint16_t> marks, std::uint16_t id,
                 BinBox box) {
    if (!map.full_turn || box.first_line > 0 || box.last_line + 1 < map.lines) return box;
    // The widest gap between two marked lines is not the object's.
    int before = 0;
    int widest = 0;
    for (int line = 1; line < map.lines; ++line) {
        const auto bins = marks.subspan(static_cast<std::size_t>(line) * map.bins, map.bins);
        if (std::ranges::find(bins, id) == bins.end()) continue;
        if (line - before > widest) {
            widest = line - before;
            box.first_line = line - map.lines;
            box.last_line = before;
        }
        before = line;
    }
    return box;
}

std::optional<double> contrast_db(const LevelMap& map, std::span<const std::uint16_t> marks,
                                  std::uint16_t id, const BinBox& marked,
                                  std::span<const std::uint8_t> is_background) {
    const BinBox box = over_seam(map, marks, id, marked);
    std::vector<RangeLevels> ranges = marked_levels(map, marks, id, box);
    add_surroundings(map, box, is_background, ranges);
    double own = 0.0;
    double around = 0.0;
    for (const RangeLevels& range : ranges) {
        if (range.count == 0 || range.count_around == 0) continue;
        own += range.level;
        around += range.level_around / range.count_around * range.count;
    }
    if (own > 0.0 || around > 0.0) return decibel_of(own / around);
    return std::nullopt;
}

std::vector<std::uint16_t> visible_shadows(const LevelMap& map,
                                           std::span<const std::uint8_t> wanted,
                                           std::span<const std::uint8_t> is_background) {
    constexpr double dark = 0.7;  // -1.5 dB
    std::map<std::uint16_t, BinBox> boxes;
    for (std::size_t k = 0; k < map.shadow.size(); ++k) {
        const std::uint16_t id = map.shadow[k];
        if (id != 0 && wanted[id] != 0)
            boxes[id].extend(static_cast<int>(k) / map.bins, static_cast<int>(k) % map.bins);
    }
    std::vector<std::uint16_t> out(map.shadow.size(), 0);
    for (const auto& [id, marked] : boxes) {
        const BinBox box = over_seam(map, map.shadow, id, marked);
        std::vector<RangeLevels> ranges = marked_levels(map, map.shadow, id, box);
        add_surroundings(map, box, is_background, ranges);
        double sum = 0.0;
        double max_sum = 0.0;
        std::size_t end = 0;
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            const RangeLevels& range = ranges[k];
            if (range.count == 0 || range.count_around == 0) continue;
            sum += dark * range.level_around / range.count_around * range.count - range.level;
            if (sum <= max_sum) continue;
            max_sum = sum;
            end = k + 1;
        }
        for (int line = box.first_line; line <= box.last_line; ++line) {
            const std::size_t begin = first_bin_of(map, line, box);
            for (std::size_t k = begin; k < begin + end; ++k)
                out[k] = map.shadow[k] == id ? id : out[k];
        }
    }
    return out;
}

}  // namespace sonarsim
