#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

// XTF, the eXtended Triton Format of side-scan data: Triton Imaging, "eXtended Triton Format (XTF)
// Rev. 40". Two channels, port and starboard, of 16 bits; positions in metres.

struct XtfFile {
    std::string sonar_name;
    float azimuth_deg = 0.0F;     ///< full angle of the swath
    float beam_width_deg = 0.0F;  ///< along the track
};

/// A ping, and where the sonar was. The frame of the world is the grid: x east, y north.
struct XtfPing {
    std::uint32_t number = 0;
    double t_s = 0.0;  ///< since 1970
    double x_m = 0.0;
    double y_m = 0.0;
    double depth_m = 0.0;      ///< below z = 0
    double altitude_m = 0.0;   ///< 0 where the bottom is not seen
    double heading_deg = 0.0;  ///< clockwise from y
    double pitch_deg = 0.0;    ///< bow up
    double roll_deg = 0.0;     ///< starboard down
    double sound_speed_m_s = 0.0;
    double range_max_m = 0.0;
    double seconds_per_ping = 0.0;
};

/// The 1,024 bytes that begin the file.
std::string xtf_header(const XtfFile& file);

/// A record of one ping. `row`: port from range_max to nadir, then starboard from nadir on; the
/// port channel keeps that order, as is usual in XTF: its last sample is at nadir.
std::string xtf_record(const XtfPing& ping, std::span<const std::uint16_t> row);

/// How long such a record is.
std::size_t xtf_record_bytes(std::size_t columns);

}  // namespace sonarsim
