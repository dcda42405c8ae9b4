#pragma once

#include <array>

namespace sonarsim {

/// The terms of the model that an image is made of. A term that the sonar's settings do not use
/// adds nothing, asked for or not.
struct Terms {
    bool direct = true;       ///< echoes of the visible surface, Eq. 4-6
    bool multipath = true;    ///< echoes by way of a second surface, Eq. 1-3
    bool range_noise = true;  ///< Eq. 7-8
    bool pixel_noise = true;  ///< Eq. 10-13, with the gain m of Eq. 12
    bool streaks = true;      ///< Eq. 14-15
};

inline constexpr Terms direct_echoes_alone{
    .multipath = false, .range_noise = false, .pixel_noise = false, .streaks = false};

inline constexpr Terms multipath_alone{
    .direct = false, .range_noise = false, .pixel_noise = false, .streaks = false};

/// One more term each time, as in the paper's Fig. 5(d): direct echoes, plus multipath, plus range
/// noise, plus pixel noise, plus streaks. The last are all terms.
inline constexpr std::array<Terms, 5> term_by_term{
    direct_echoes_alone,
    Terms{.range_noise = false, .pixel_noise = false, .streaks = false},
    Terms{.pixel_noise = false, .streaks = false},
    Terms{.streaks = false},
    Terms{},
};

}  // namespace sonarsim
