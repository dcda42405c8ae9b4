#pragma once

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

/// The number of a warning: 12 is "W12". A number keeps its meaning in all versions.
enum class WarningCode {
    reading = 1,
    scene_out_of_scale = 4,
    material_silent = 9,
    below_surface = 10,
    inside_object = 11,
    blind = 12,
    range_too_short = 13,
    range_begins_late = 14,
    elevation_too_narrow = 15,
    looks_elsewhere = 16,
    nothing_near = 17,
    below_noise = 18,
    saturated = 19,
    dim = 20,
    hidden_object = 21,
    memory = 26,
    no_locks = 28,
    goal_missed = 29,
    heightmap_facets = 37,
    azimuth_in_radians = 38,
    ping_too_early = 39,
    scene_ends = 40,
};

/// A row of the table of all warnings. `what` and `cure` are format strings of the same figures.
struct WarningText {
    WarningCode code;
    const char* what;   ///< the finding
    const char* cure;   ///< the remedy
    const char* limit;  ///< the limit from which on the program warns
};

/// All warnings in the order of their numbers. A number that is gone is not used again.
std::span<const WarningText> warning_table();
/// The table in Markdown, for docs/warnings.md.
std::string warning_table_markdown();

struct Warning {
    WarningCode code;
    std::string about;  ///< "sensor 'fls'"
    std::string what;
    std::string cure;
};

/// `figures` fill both format strings of the table's row.
template <class... Figures>
Warning make_warning(WarningCode code, std::string about, const Figures&... figures) {
    const WarningText& text = *std::ranges::find(warning_table(), code, &WarningText::code);
    return {code, std::move(about), fmt::vformat(text.what, fmt::make_format_args(figures...)),
            fmt::vformat(text.cure, fmt::make_format_args(figures...))};
}

void append(std::vector<Warning>& out, std::vector<Warning> more);

/// "W12".
std::string number_of(WarningCode code);

/// "W12 sensor 'fls': 3 of 36 pings ...; raise ...".
std::string sentence(const Warning& warning);

/// "sensor 'fls'".
std::string about_sensor(std::string_view name);

}  // namespace sonarsim
