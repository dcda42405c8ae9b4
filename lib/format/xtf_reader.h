#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "format/logged_soundings.h"

namespace sonarsim {

/// A side of a ping in an XTF file, the sample at nadir first.
struct XtfSide {
    std::vector<float> samples;
    double slant_range_m = 0.0;  ///< to the end of the last sample
    double full_value = 0.0;     ///< the largest that a sample can be; 0 for floats
};

struct XtfSidescanPing {
    double t_s = 0.0;  ///< since 1970
    double sound_speed_m_s = 0.0;
    double altitude_m = 0.0;  ///< 0: not known
    XtfSide port;
    XtfSide starboard;
};

/// The side-scan pings of an XTF file: each ping's first port channel and first starboard channel.
/// Samples are unsigned 8 or 16 bits, 32 bits or IEEE floats, times 2^-weight of the channel.
struct XtfPings {
    double full_value = 0.0;    ///< the largest of all sides
    double frequency_hz = 0.0;  ///< 0: not known
    std::vector<XtfSidescanPing> pings;
};

/// Reads the first `most_pings` pings; records of other kinds are skipped. Throws
/// std::runtime_error with the reason when the file is no XTF, is cut off within a record, or holds
/// samples of another kind.
XtfPings read_xtf(std::string_view bytes, std::size_t most_pings);

/// Reads the first pings with soundings, in the records XTF_HEADER_Q_MULTIBEAM (28). Throws
/// std::runtime_error as read_xtf().
std::vector<LoggedSoundings> read_xtf_soundings(std::string_view bytes, std::size_t most_pings);

}  // namespace sonarsim
