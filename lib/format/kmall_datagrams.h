#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "format/byte_fields.h"

namespace sonarsim {

// Kongsberg, "EM datagrams on *.kmall format", revisions F to I. A datagram begins with 20 bytes:
// its length, its type, version, system, echo sounder, seconds and nanoseconds since 1970. Blocks
// begin with their own length, so that newer fields are skipped.
inline constexpr std::size_t kmall_header = 20;
inline constexpr std::size_t kmall_partition = 4;
inline constexpr std::size_t kmall_common = kmall_header + kmall_partition;

/// Part of a datagram, or of a file. Throws std::runtime_error beyond its end.
inline std::string_view part_of_datagram(std::string_view bytes, std::size_t at,
                                         std::size_t length) {
    if (at > bytes.size() || bytes.size() - at < length)
        throw std::runtime_error("has a datagram that is cut off");
    return bytes.substr(at, length);
}

/// Calls `take` for the datagrams of a type that belong to the first of several receiving fans,
/// until `take` returns false.
template <class Take>
void for_each_kmall(std::string_view bytes, std::string_view type, const Take& take) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = field_at<std::uint32_t>(bytes, at);
        if (length < kmall_header)
            throw std::runtime_error("has no datagram where one should begin");
        const std::string_view datagram = part_of_datagram(bytes, at, length);
        at += length;
        if (datagram.substr(4, 4) != type) continue;
        if (field_at<std::uint8_t>(datagram, kmall_common + 5) != 0) continue;
        if (field_at<std::uint16_t>(datagram, kmall_header) > 1)
            throw std::runtime_error("has pings in several partitions, which are not read");
        if (!take(datagram)) return;
    }
}

/// Seconds since 1970 of a datagram.
inline double kmall_time_s(std::string_view datagram) {
    return field_at<std::uint32_t>(datagram, 12) + 1e-9 * field_at<std::uint32_t>(datagram, 16);
}

}  // namespace sonarsim
