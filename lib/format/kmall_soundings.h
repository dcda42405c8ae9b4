#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "format/logged_soundings.h"
#include "format/sonar_log.h"

namespace sonarsim {

/// The law of the soundings' intensities: 200 dB from the value 0 to 200, which is 0 dB.
inline constexpr LoggedDecibels kmall_sounding_law{200.0, 200.0};

/// The soundings of a Kongsberg multibeam (#MRZ datagrams) in a .kmall. Intensities are its
/// `reflectivity2`: levels with a simple TVG, without a law of the bottom. Angles are those of the
/// depth point below the transmitter, so that roll and refraction are taken out. The first of
/// several fans of a ping is read. Throws std::runtime_error with the reason when the file has
/// another format, is damaged or has no soundings.
std::vector<LoggedSoundings> read_kmall_soundings(std::string_view bytes, std::size_t most_pings);

}  // namespace sonarsim
