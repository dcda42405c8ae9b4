#include "format/xtf_reader.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "format/byte_fields.h"

namespace sonarsim {

namespace {

// Triton Imaging, "eXtended Triton Format (XTF) Rev. 40"; format/xtf.cpp writes it.
constexpr std::size_t xtf_file_header = 1024;
constexpr std::size_t xtf_channel_info = 128;
constexpr std::size_t xtf_ping_header = 256;
constexpr std::size_t xtf_channel_header = 64;
constexpr std::size_t xtf_sounding = 64;
constexpr int xtf_side_scan = 0, xtf_multibeam = 28;
constexpr std::size_t most_channels = 64;
constexpr double longest_range_m = 1e5;
constexpr double longest_s = 100.0;
constexpr double largest_intensity = 1e30;

enum class XtfSample { byte, word, integer, real };

struct XtfChannel {
    int type = 0;  ///< 1: port, 2: starboard
    XtfSample sample = XtfSample::word;
};

[[noreturn]] void refuse_xtf(const std::string& what) {
    throw std::runtime_error(what);
}

std::size_t bytes_of(XtfSample sample) {
    if (sample == XtfSample::byte) return 1;
    return sample == XtfSample::word ? 2 : 4;
}

/// The kind of samples by the field SampleFormat, or in older files, where it is 0, by the bytes.
XtfSample sample_of(std::string_view bytes, std::size_t at) {
    const int format = field_at<std::uint8_t>(bytes, at + 74);
    const int size = field_at<std::uint16_t>(bytes, at + 6);
    if (format == 8 || (format == 0 && size == 1)) return XtfSample::byte;
    if (format == 3 || (format == 0 && size == 2)) return XtfSample::word;
    if (format == 2 || (format == 0 && size == 4)) return XtfSample::integer;
    if (format == 5) return XtfSample::real;
    refuse_xtf("has samples of the format " + std::to_string(format) +
               "; those of 8, 16 and 32 bits and IEEE floats are read");
}

std::vector<XtfChannel> channels_of(std::string_view bytes) {
    if (field_at<std::uint8_t>(bytes, 0) != 0x7B) refuse_xtf("is no XTF file");
    const std::size_t count =
        std::size_t{field_at<std::uint16_t>(bytes, 166)} + field_at<std::uint16_t>(bytes, 168);
    if (count == 0 || count > most_channels) refuse_xtf("has no channels of a sonar, or too many");
    std::vector<XtfChannel> channels;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = 256 + k * xtf_channel_info;
        XtfChannel channel{field_at<std::uint8_t>(bytes, at), XtfSample::word};
        const bool is_side = channel.type == 1 || channel.type == 2;
        if (is_side) channel.sample = sample_of(bytes, at);
        channels.push_back(channel);
    }
    return channels;
}

double time_of(std::string_view record) {
    using namespace std::chrono;
    const year_month_day date(year(field_at<std::uint16_t>(record, 14)),
                              month(field_at<std::uint8_t>(record, 16)),
                              day(field_at<std::uint8_t>(record, 17)));
    const double days =
        date.ok() ? static_cast<double>(sys_days(date).time_since_epoch().count()) : 0.0;
    return 86400.0 * days + 3600.0 * field_at<std::uint8_t>(record, 18) +
           60.0 * field_at<std::uint8_t>(record, 19) + field_at<std::uint8_t>(record, 20) +
           0.01 * field_at<std::uint8_t>(record, 21);
}

double sound_speed_of(std::string_view record) {
    const double speed = field_at<float>(record, 72);
    return speed > 0.0 ? speed : 2.0 * field_at<float>(record, 32);
}

float sample_at(std::string_view bytes, XtfSample kind, std::size_t k) {
    switch (kind) {
        case XtfSample::byte:
            return field_at<std::uint8_t>(bytes, k);
        case XtfSample::word:
            return field_at<std::uint16_t>(bytes, 2 * k);
        case XtfSample::integer:
            return static_cast<float>(field_at<std::uint32_t>(bytes, 4 * k));
        case XtfSample::real:
            return field_at<float>(bytes, 4 * k);
    }
    return 0.0F;
}

/// Reads the channel whose header begins at `at`, and moves `at` behind its samples.
XtfSide side_at(std::string_view record, XtfChannel channel, std::size_t& at) {
    XtfSide side;
    side.slant_range_m = field_at<float>(record, at + 4);
    const std::size_t samples = field_at<std::uint32_t>(record, at + 42);
    const int weight = field_at<std::int16_t>(record, at + 58);
    at += xtf_channel_header;
    const std::size_t bytes = bytes_of(channel.sample);
    if (at > record.size() || samples > (record.size() - at) / bytes)
        refuse_xtf("has more samples than their record");
    const auto factor = static_cast<float>(std::ldexp(1.0, -std::clamp(weight, -64, 64)));
    constexpr std::array full_values{255.0, 65535.0, 4294967295.0, 0.0};
    side.full_value = factor * full_values[static_cast<std::size_t>(channel.sample)];
    for (std::size_t k = 0; k < samples; ++k)
        side.samples.push_back(factor * sample_at(record.substr(at), channel.sample, k));
    at += samples * bytes;
    return side;
}

/// The ping of a record; nothing if it lacks a side.
std::optional<XtfSidescanPing> ping_of_record(std::string_view record,
                                              const std::vector<XtfChannel>& channels,
                                              double& frequency_hz) {
    XtfSidescanPing ping;
    ping.t_s = time_of(record);
    ping.sound_speed_m_s = sound_speed_of(record);
    ping.altitude_m = field_at<float>(record, 196);
    const std::size_t count = field_at<std::uint16_t>(record, 4);
    std::size_t at = xtf_ping_header;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t number = field_at<std::uint16_t>(record, at);
        if (number >= channels.size()) refuse_xtf("has a ping of a channel that its header lacks");
        const XtfChannel channel = channels[number];
        const std::size_t header = at;
        XtfSide side = side_at(record, channel, at);
        if (!(side.slant_range_m > 0.0 && side.slant_range_m < longest_range_m) ||
            side.samples.empty())
            continue;
        if (channel.type == 1 && ping.port.samples.empty()) {
            std::ranges::reverse(side.samples);  // stored with nadir last
            ping.port = std::move(side);
            frequency_hz = 1e3 * field_at<std::uint16_t>(record, header + 26);
        } else if (channel.type == 2 && ping.starboard.samples.empty()) {
            ping.starboard = std::move(side);
        }
    }
    if (ping.port.samples.empty() || ping.starboard.samples.empty()) return std::nullopt;
    return ping;
}

/// The soundings of a multibeam's record: entries of 64 bytes behind the header of a ping.
LoggedSoundings soundings_of_record(std::string_view record) {
    LoggedSoundings ping;
    ping.t_s = time_of(record);
    ping.sound_speed_m_s = sound_speed_of(record);
    const std::size_t count = field_at<std::uint16_t>(record, 4);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = xtf_ping_header + k * xtf_sounding;
        const LoggedSounding beam{.two_way_s = field_at<double>(record, at + 16),
                                  .angle_deg = field_at<double>(record, at + 32),
                                  .intensity = field_at<double>(record, at + 4)};
        if (!(beam.two_way_s > 0.0)) continue;
        if (!(beam.two_way_s < longest_s && std::fabs(beam.angle_deg) <= 180.0 &&
              beam.intensity >= 0.0 && beam.intensity < largest_intensity))
            refuse_xtf("has a sounding with impossible numbers");
        ping.beams.push_back(beam);
    }
    return ping;
}

/// Calls `visit(record)` for the records of a type until `visit` returns false.
template <class Visit>
void for_each_record(std::string_view bytes, std::size_t channels, int type, const Visit& visit) {
    // Six channels fit into the first 1,024 bytes, eight into each further 1,024.
    std::size_t at = xtf_file_header;
    if (channels > 6) at += (channels - 6 + 7) / 8 * xtf_file_header;
    while (at < bytes.size()) {
        if (field_at<std::uint16_t>(bytes, at) != 0xFACE)
            refuse_xtf("has no record where one should begin");
        const std::size_t length = field_at<std::uint32_t>(bytes, at + 10);
        if (length < 14 || length > bytes.size() - at) refuse_xtf("is cut off within a record");
        const bool is_wanted = field_at<std::uint8_t>(bytes, at + 2) == type;
        if (is_wanted && !visit(bytes.substr(at, length))) return;
        at += length;
    }
}

}  // namespace

XtfPings read_xtf(std::string_view bytes, std::size_t most_pings) {
    const std::vector<XtfChannel> channels = channels_of(bytes);
    XtfPings out;
    for_each_record(bytes, channels.size(), xtf_side_scan, [&](std::string_view record) {
        auto ping = ping_of_record(record, channels, out.frequency_hz);
        if (ping) {
            out.full_value =
                std::max({out.full_value, ping->port.full_value, ping->starboard.full_value});
            out.pings.push_back(std::move(*ping));
        }
        return out.pings.size() < most_pings;
    });
    return out;
}

std::vector<LoggedSoundings> read_xtf_soundings(std::string_view bytes, std::size_t most_pings) {
    std::vector<LoggedSoundings> pings;
    const std::size_t channels = channels_of(bytes).size();
    for_each_record(bytes, channels, xtf_multibeam, [&](std::string_view record) {
        pings.push_back(soundings_of_record(record));
        return pings.size() < most_pings;
    });
    return pings;
}

}  // namespace sonarsim
