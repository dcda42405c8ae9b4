#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace sonarsim::test {

template <class T>
void place(std::string& bytes, std::size_t at, T value) {
    std::memcpy(&bytes[at], &value, sizeof value);
}

/// A message of 3 ranges and 2 beams. Version 2 has 36 bytes more in its fire message, and attitude
/// and spare fields.
inline std::string oculus_message(int version, int size, const std::vector<std::uint8_t>& image) {
    const std::size_t fire = version == 2 ? 89 : 53;
    const std::size_t more = version == 2 ? 24 : 0;  // heading, pitch and roll
    const std::size_t time = version == 2 ? 8 : 4;
    const std::size_t spare = version == 2 ? 16 : 0;
    std::string bytes(fire + 69 - 4 + more + time + spare + 4, '\0');
    place<std::uint16_t>(bytes, 0, 0x4f53);
    place<std::uint16_t>(bytes, 6, 0x23);
    place<std::uint16_t>(bytes, 8, static_cast<std::uint16_t>(version));
    place<double>(bytes, fire + 8, 2.1e6);
    place<double>(bytes, fire + 32 + more, 1490.0);
    const std::size_t value_size = fire + 40 + more + time;
    place<std::uint8_t>(bytes, value_size, static_cast<std::uint8_t>(size));
    place<double>(bytes, value_size + 1, 0.25);
    place<std::uint16_t>(bytes, value_size + 9, 3);
    place<std::uint16_t>(bytes, value_size + 11, 2);
    const std::size_t end = value_size + 13 + spare;
    place<std::int16_t>(bytes, end + 12, -3000);
    place<std::int16_t>(bytes, end + 14, 1550);
    place<std::uint32_t>(bytes, end, static_cast<std::uint32_t>(bytes.size()));
    place<std::uint32_t>(bytes, end + 4, static_cast<std::uint32_t>(image.size()));
    bytes.append(image.begin(), image.end());
    place<std::uint32_t>(bytes, 10, static_cast<std::uint32_t>(bytes.size() - 16));
    return bytes;
}

}  // namespace sonarsim::test
