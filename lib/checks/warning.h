#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>
#include <string_view>

namespace sonarsim {

/// What may be wrong with a mission that is valid. A number belongs to one of them for good.
enum class Doubt {
    reading = 1,
    scene_huge = 2,
    scene_tiny = 3,
    scene_out_of_scale = 4,
    scene_on_edge = 5,
    water_density = 6,
    water_speed = 7,
    material_units = 8,
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
    unseen_object = 21,
    radians = 22,
    quaternion_order = 23,
    engine = 24,
    doubled_triangles = 25,
    memory = 26,
};

/// A doubt with its figures.
struct Warning {
    Doubt doubt;
    std::string about;  ///< "sensor 'fls'"
    std::string what;
    std::string cure;
};

/// The format strings of a doubt: what is found, and what would mend it. Both take the same
/// figures.
struct WarningWords {
    const char* what;
    const char* cure;
};
WarningWords words_of(Doubt doubt);

template <class... Figures>
Warning make_warning(Doubt doubt, std::string about, const Figures&... figures) {
    const WarningWords words = words_of(doubt);
    return {doubt, std::move(about), fmt::vformat(words.what, fmt::make_format_args(figures...)),
            fmt::vformat(words.cure, fmt::make_format_args(figures...))};
}

/// "W12".
std::string number_of(Doubt doubt);

/// "W12 sensor 'fls': 3 of 36 pings ...; raise ...".
std::string sentence(const Warning& warning);

/// "sensor 'fls'".
std::string about_sensor(std::string_view name);

}  // namespace sonarsim
