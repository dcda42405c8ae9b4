#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

// XTF, the eXtended Triton Format of side-scan data: Triton Imaging, "eXtended Triton Format (XTF)
// Rev. 40". Two channels, port and starboard, of 16 bits; positions in metres.

struct XtfFile {
    std::string sonar_name;
    float frequency_khz = 0.0F;     ///< 0: unknown
    float beam_width_deg = 0.0F;    ///< beamwidth along track
    float across_width_deg = 0.0F;  ///< beamwidth of a side across track
    float tilt_deg = 0.0F;          ///< depression of a side's axis
};

/// A ping and the sonar's pose. The world's frame is the grid: x east, y north.
struct XtfPing {
    std::uint32_t number = 0;
    double t_s = 0.0;  ///< since 1970
    Eigen::Vector2d ship_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d sensor_m = Eigen::Vector2d::Zero();
    double speed_m_s = 0.0;    ///< over ground
    double depth_m = 0.0;      ///< depth below the water's surface
    double altitude_m = 0.0;   ///< 0: the bottom is not seen
    double heading_deg = 0.0;  ///< the sensor's, clockwise from y
    double ship_heading_deg = 0.0;
    double pitch_deg = 0.0;  ///< bow up
    double roll_deg = 0.0;   ///< starboard down
    double sound_speed_m_s = 0.0;
    double range_max_m = 0.0;
    double seconds_per_ping = 0.0;
};

/// The header of the file, 1,024 bytes.
std::string xtf_header(const XtfFile& file);

/// The record of a ping. `row`, and with it the channels, has port from range_max to nadir, as is
/// usual in XTF (its last sample is at nadir), then starboard from nadir on.
std::string xtf_record(const XtfFile& file, const XtfPing& ping,
                       std::span<const std::uint16_t> row);

}  // namespace sonarsim
