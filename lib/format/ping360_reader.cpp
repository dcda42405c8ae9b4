#include <cstdint>
#include <optional>
#include <stdexcept>

#include "core/units.h"
#include "format/byte_fields.h"
#include "format/sonar_log.h"

namespace sonarsim {

namespace {

// Blue Robotics, Ping Protocol: "BR", the length of the payload, the message's number, source and
// destination, the payload, and the sum of all bytes before.
constexpr std::string_view ping_mark = "BR";
constexpr std::size_t ping_header = 8;
constexpr std::uint16_t device_data = 2300;
constexpr std::uint16_t auto_device_data = 2301;
constexpr double period_s = 25e-9;
constexpr double gradian = pi / 200.0;

/// The message at the beginning of the bytes, if its checksum is right.
std::optional<std::string_view> checked_message(std::string_view bytes) {
    if (bytes.size() < ping_header + 2) return std::nullopt;
    const std::size_t length = ping_header + field_at<std::uint16_t>(bytes, 2);
    if (bytes.size() < length + 2) return std::nullopt;
    std::uint16_t sum = 0;
    for (const char byte : bytes.substr(0, length))
        sum = static_cast<std::uint16_t>(sum + static_cast<unsigned char>(byte));
    if (sum != field_at<std::uint16_t>(bytes, length)) return std::nullopt;
    return bytes.substr(0, length);
}

/// Adds the ping of a message with samples.
void add_ping(std::string_view payload, bool is_auto, SonarLog& log) {
    const std::size_t data_at = is_auto ? 20 : 14;
    const std::size_t count = field_at<std::uint16_t>(payload, data_at - 2);
    if (count == 0) return;
    if (payload.size() - data_at < count)
        throw std::runtime_error("has a ping with more samples than their message");
    const double step_s = period_s * field_at<std::uint16_t>(payload, 6);
    const double frequency_hz = 1e3 * field_at<std::uint16_t>(payload, 8);
    if (step_s == 0.0) throw std::runtime_error("has a ping without a step of range");
    if (log.pings.empty()) {
        log.range_step_s = step_s;
        log.first_range_s = 0.5 * step_s;
        log.frequency_hz = frequency_hz;
    }
    LoggedPing ping;
    ping.ranges = static_cast<int>(count);
    ping.beams = 1;
    if (step_s != log.range_step_s ||
        (!log.pings.empty() && ping.ranges != log.pings.front().ranges))
        throw std::runtime_error("changes its range; split the file there");
    ping.bearing_rad = -gradian * field_at<std::uint16_t>(payload, 2);
    for (const char value : payload.substr(data_at, count))
        ping.values.push_back(static_cast<unsigned char>(value));
    log.pings.push_back(std::move(ping));
}

}  // namespace

SonarLog read_ping360(std::string_view bytes, std::size_t most_pings) {
    SonarLog log;
    log.kind = LoggedKind::scanning;
    std::size_t at = bytes.find(ping_mark);
    while (at != std::string_view::npos && log.pings.size() < most_pings) {
        const auto message = checked_message(bytes.substr(at));
        if (message) {
            const auto number = field_at<std::uint16_t>(*message, 4);
            if (number == device_data || number == auto_device_data)
                add_ping(message->substr(ping_header), number == auto_device_data, log);
        }
        at = bytes.find(ping_mark, at + (message ? message->size() : ping_mark.size()));
    }
    if (log.pings.empty())
        throw std::runtime_error(
            "is no .all, .kmall, .raw of an EK60 or EK80, .ddf or .aris, and has no pings of a "
            "Ping360");
    return log;
}

}  // namespace sonarsim
