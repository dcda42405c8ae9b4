#include "output/format/xtf.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/build_info.h"

namespace sonarsim {

namespace {

static_assert(std::endian::native == std::endian::little, "XTF is little-endian");

constexpr std::size_t file_header_bytes = 1024;
constexpr std::size_t channels_at = 256;  ///< offset in the file's header
constexpr std::size_t channel_bytes = 128;
constexpr std::size_t ping_header_bytes = 256;
constexpr std::size_t channel_header_bytes = 64;
constexpr std::size_t record_unit = 64;  ///< the size of a record is a multiple of it

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(&bytes[at], &value, sizeof value);
}

/// Writes a text and a zero byte.
void put_text(std::string& bytes, std::size_t at, std::string_view text, std::size_t room) {
    std::memcpy(&bytes[at], text.data(), std::min(text.size(), room - 1));
}

void put_channel(std::string& header, std::uint8_t type, const XtfFile& file) {
    constexpr std::uint8_t two_byte_integer = 3;
    const bool port = type == 1;
    const std::size_t at = channels_at + (port ? 0 : channel_bytes);
    put<std::uint8_t>(header, at, type);
    put<std::uint16_t>(header, at + 2, 1);  // slant range
    put<std::uint16_t>(header, at + 4, 1);  // unipolar
    put<std::uint16_t>(header, at + 6, 2);  // bytes per sample
    put_text(header, at + 12, port ? "Port" : "Starboard", 16);
    put(header, at + 32, file.frequency_khz);
    put(header, at + 36, file.beam_width_deg);
    put(header, at + 40, file.tilt_deg);
    put(header, at + 44, file.across_width_deg);
    put<std::uint8_t>(header, at + 74, two_byte_integer);
}

/// Writes the date and time of day to the fields from byte 14 on.
void put_time(std::string& record, double t_s) {
    using namespace std::chrono;
    // 0.29 s times 100 is less than 29.
    const auto hundredths = static_cast<std::int64_t>(std::floor(t_s * 100.0 + 1e-3));
    const sys_time<duration<std::int64_t, std::centi>> time{
        duration<std::int64_t, std::centi>(hundredths)};
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    const auto day_of_year = (day - sys_days(date.year() / January / 1)).count() + 1;
    put(record, 14, static_cast<std::uint16_t>(static_cast<int>(date.year())));
    put(record, 16, static_cast<std::uint8_t>(static_cast<unsigned>(date.month())));
    put(record, 17, static_cast<std::uint8_t>(static_cast<unsigned>(date.day())));
    put(record, 18, static_cast<std::uint8_t>(clock.hours().count()));
    put(record, 19, static_cast<std::uint8_t>(clock.minutes().count()));
    put(record, 20, static_cast<std::uint8_t>(clock.seconds().count()));
    put(record, 21, static_cast<std::uint8_t>(clock.subseconds().count()));
    put(record, 22, static_cast<std::uint16_t>(day_of_year));
}

void put_float(std::string& record, std::size_t at, double value) {
    put(record, at, static_cast<float>(value));
}

}  // namespace

std::string xtf_header(const XtfFile& file) {
    std::string header(file_header_bytes, '\0');
    put<std::uint8_t>(header, 0, 0x7B);
    put<std::uint8_t>(header, 1, 1);
    put_text(header, 2, "sonarsim", 9);
    put_text(header, 10, build_info().version, 8);
    put_text(header, 18, file.sonar_name, 16);
    put<std::uint16_t>(header, 164, 0);  // positions in metres
    put<std::uint16_t>(header, 166, 2);  // channels of a sonar
    put_channel(header, 1, file);
    put_channel(header, 2, file);
    return header;
}

std::string xtf_record(const XtfFile& file, const XtfPing& ping,
                       std::span<const std::uint16_t> row) {
    const std::size_t bytes = ping_header_bytes + 2 * channel_header_bytes + row.size_bytes();
    std::string record((bytes + record_unit - 1) / record_unit * record_unit, '\0');
    put<std::uint16_t>(record, 0, 0xFACE);
    put<std::uint16_t>(record, 4, 2);  // channels that follow
    put(record, 10, static_cast<std::uint32_t>(record.size()));
    put_time(record, ping.t_s);
    put(record, 28, ping.number);
    put_float(record, 32, ping.sound_speed_m_s / 2.0);  // XTF has half the speed, for two-way time
    put_float(record, 72, ping.sound_speed_m_s);
    const double knots = ping.speed_m_s * 3600.0 / 1852.0;
    put_float(record, 120, knots);
    put_float(record, 124, ping.ship_heading_deg);
    put(record, 128, ping.ship_m.y());
    put(record, 136, ping.ship_m.x());
    put_float(record, 152, knots);
    put(record, 160, ping.sensor_m.y());
    put(record, 168, ping.sensor_m.x());
    put_float(record, 192, ping.depth_m);
    put_float(record, 196, ping.altitude_m);
    put_float(record, 204, ping.pitch_deg);
    put_float(record, 208, ping.roll_deg);
    put_float(record, 212, ping.heading_deg);
    put_float(record, 220, ping.heading_deg);

    const std::size_t samples = row.size() / 2;
    std::size_t at = ping_header_bytes;
    for (const std::uint16_t channel : {0, 1}) {
        put(record, at, channel);
        put_float(record, at + 4, ping.range_max_m);
        put_float(record, at + 8,
                  std::sqrt(std::max(0.0, ping.range_max_m * ping.range_max_m -
                                              ping.altitude_m * ping.altitude_m)));
        put_float(record, at + 16, 2.0 * ping.range_max_m / ping.sound_speed_m_s);
        put_float(record, at + 20, ping.seconds_per_ping);
        put(record, at + 26, static_cast<std::uint16_t>(std::lround(file.frequency_khz)));
        put(record, at + 42, static_cast<std::uint32_t>(samples));
        at += channel_header_bytes;
        std::memcpy(&record[at], row.data() + channel * samples, 2 * samples);
        at += 2 * samples;
    }
    return record;
}

}  // namespace sonarsim
