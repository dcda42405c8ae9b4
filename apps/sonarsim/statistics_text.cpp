#include "statistics_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/text.h"
#include "logging.h"

namespace sonarsim {

namespace {

/// "2 to 3"
std::string interval_text(std::span<const double> edges, std::size_t k) {
    if (k == 0) return fmt::format("below {}", edges[0]);
    if (k == edges.size()) return fmt::format("from {}", edges[k - 1]);
    return fmt::format("{} to {}", edges[k - 1], edges[k]);
}

/// "2 to 3: 14, 3 to 5: 20"; empty if no annotation has the value.
std::string histogram_text(const PictureTally& tally, std::size_t axis) {
    const std::span<const double> edges = all_statistics_axes()[axis].edges;
    std::string text;
    for (std::size_t k = 0; k <= edges.size(); ++k) {
        std::uint64_t sum = 0;
        for (const ClassTally& one : tally.classes)
            sum += one.histograms[axis][k];
        if (sum == 0) continue;
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", interval_text(edges, k), sum);
    }
    return text;
}

}  // namespace

std::string statistics_text(const PictureTally& tally) {
    std::size_t width = 5;
    for (const ClassTally& one : tally.classes)
        width = std::max(width, printable(one.name).size());
    std::string text = result_line("labels", fmt::format("{} pictures, {} without an object",
                                                         tally.pictures, tally.without_objects));
    text += fmt::format("  {:<{}} {:>8} {:>9} {:>9} {:>8}\n", "class", width, "objects", "pictures",
                        "labels", "ignored");
    for (const ClassTally& one : tally.classes) {
        text += fmt::format("  {:<{}} {:>8} {:>9} {:>9} {:>8}\n", printable(one.name), width,
                            one.objects, one.pictures, one.annotations, one.ignored);
    }
    for (std::size_t axis = 0; axis < statistics_axes; ++axis) {
        const std::string counts = histogram_text(tally, axis);
        if (counts.empty()) continue;
        text += fmt::format("  {}: {}\n", all_statistics_axes()[axis].title, counts);
    }
    return text;
}

}  // namespace sonarsim
