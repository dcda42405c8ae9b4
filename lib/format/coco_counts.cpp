#include "format/coco_counts.h"

namespace sonarsim {

std::string coco_counts(std::span<const std::uint32_t> runs) {
    std::string text;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        std::int64_t left = runs[k];
        if (k > 2) left -= runs[k - 2];
        bool more = true;
        while (more) {
            auto group = static_cast<char>(left & 0x1F);
            left >>= 5;
            // The fifth bit of the last group is the sign.
            more = (group & 0x10) != 0 ? left != -1 : left != 0;
            if (more) group |= 0x20;
            text += static_cast<char>(group + '0');
        }
    }
    return text;
}

std::optional<std::vector<std::uint32_t>> coco_runs(std::string_view counts, std::uint64_t pixels) {
    constexpr int most_groups = 7;  // a run of 2^31 takes fewer groups of five bits
    std::vector<std::uint32_t> runs;
    std::int64_t left = static_cast<std::int64_t>(pixels);
    for (std::size_t at = 0; at < counts.size();) {
        std::int64_t value = 0;
        bool more = true;
        for (int group = 0; more; ++group) {
            if (at == counts.size() || group == most_groups) return std::nullopt;
            const int code = counts[at++] - '0';
            if (code < 0 || code > 0x3F) return std::nullopt;
            value |= static_cast<std::int64_t>(code & 0x1F) << (5 * group);
            more = (code & 0x20) != 0;
            if (!more && (code & 0x10) != 0) value -= std::int64_t{1} << (5 * group + 5);
        }
        if (runs.size() > 2) value += runs[runs.size() - 2];
        if (value < (runs.empty() ? 0 : 1) || value > left) return std::nullopt;
        left -= value;
        runs.push_back(static_cast<std::uint32_t>(value));
    }
    if (left != 0) return std::nullopt;
    return runs;
}

}  // namespace sonarsim
