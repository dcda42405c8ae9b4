#include "format/oculus_reader.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "format/byte_fields.h"

namespace sonarsim {

namespace {

// The messages of the Oculus SDK, packed, little-endian. A header of 16 bytes: 0x4f53, two devices,
// the kind of message, its version, the length of what follows.
constexpr std::uint16_t oculus_mark = 0x4f53;
constexpr std::uint16_t simple_ping_result = 0x23;
constexpr std::size_t oculus_header = 16;
constexpr std::size_t flags_at = 20;
constexpr unsigned sends_gain = 4;

/// The places of the fields in a message of one version.
struct OculusLayout {
    std::size_t frequency, sound_speed, value_bytes, range_step, ranges, beams, image_at,
        image_bytes, bearings;
};
constexpr OculusLayout first_version{61, 85, 97, 98, 106, 108, 110, 114, 122};
constexpr OculusLayout second_version{97, 145, 161, 162, 170, 172, 190, 194, 202};

/// The message at the begin of `bytes`, if it is a whole ping result.
std::optional<std::string_view> message_at(std::string_view bytes) {
    if (bytes.size() < oculus_header || field_at<std::uint16_t>(bytes, 0) != oculus_mark ||
        field_at<std::uint16_t>(bytes, 6) != simple_ping_result)
        return std::nullopt;
    const std::size_t length = oculus_header + field_at<std::uint32_t>(bytes, 10);
    if (length > bytes.size()) return std::nullopt;
    return bytes.substr(0, length);
}

float value_at(std::string_view image, std::size_t value_bytes, std::size_t k) {
    if (value_bytes == 1) return field_at<std::uint8_t>(image, k);
    if (value_bytes == 2) return field_at<std::uint16_t>(image, 2 * k);
    return static_cast<float>(field_at<std::uint32_t>(image, 4 * k));
}

OculusPing ping_of_message(std::string_view message) {
    const OculusLayout& at =
        field_at<std::uint16_t>(message, 8) == 2 ? second_version : first_version;
    if ((field_at<std::uint8_t>(message, flags_at) & sends_gain) != 0)
        throw std::runtime_error(
            "has pings with a gain for each range, which are not read; record without `send gain`");
    // The sizes 0, 1 and 3 are 8, 16 and 32 bits.
    const int size = field_at<std::uint8_t>(message, at.value_bytes);
    if (size != 0 && size != 1 && size != 3)
        throw std::runtime_error("has values of 24 bits or of no known size");
    const auto value_bytes = static_cast<std::size_t>(size) + 1;
    OculusPing ping;
    ping.frequency_hz = field_at<double>(message, at.frequency);
    ping.sound_speed_m_s = field_at<double>(message, at.sound_speed);
    ping.range_step_m = field_at<double>(message, at.range_step);
    ping.ranges = field_at<std::uint16_t>(message, at.ranges);
    ping.beams = field_at<std::uint16_t>(message, at.beams);
    ping.full_value = std::ldexp(1.0, 8 * static_cast<int>(value_bytes)) - 1.0;
    const std::size_t values =
        static_cast<std::size_t>(ping.ranges) * static_cast<std::size_t>(ping.beams);
    const std::size_t image_at = field_at<std::uint32_t>(message, at.image_at);
    const bool is_sound = values > 0 && ping.range_step_m > 0.0 && ping.range_step_m < 1e3 &&
                          image_at <= message.size() &&
                          values <= (message.size() - image_at) / value_bytes &&
                          field_at<std::uint32_t>(message, at.image_bytes) == values * value_bytes;
    if (!is_sound) throw std::runtime_error("has a ping whose image does not fit its message");
    const std::string_view image = message.substr(image_at);
    ping.values.reserve(values);
    for (std::size_t k = 0; k < values; ++k)
        ping.values.push_back(value_at(image, value_bytes, k));
    for (std::size_t j = 0; j < static_cast<std::size_t>(ping.beams); ++j)
        ping.bearing_deg.push_back(0.01 * field_at<std::int16_t>(message, at.bearings + 2 * j));
    return ping;
}

}  // namespace

std::vector<OculusPing> read_oculus(std::string_view bytes, std::size_t most_pings) {
    constexpr std::string_view mark("SO", 2);
    std::vector<OculusPing> pings;
    std::size_t at = bytes.find(mark);
    while (at != std::string_view::npos && pings.size() < most_pings) {
        const auto message = message_at(bytes.substr(at));
        if (message) pings.push_back(ping_of_message(*message));
        at = bytes.find(mark, at + (message ? message->size() : 1));
    }
    if (pings.empty()) throw std::runtime_error("has no ping result of an Oculus");
    return pings;
}

}  // namespace sonarsim
