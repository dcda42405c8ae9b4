#include "dataset/finite_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace sonarsim {

namespace {

/// The greatest magnitude among `values`; not finite as soon as one of them is not. Without their
/// sign the bits of floats have the order of the numbers, infinity above all of them and NaN above
/// that; and unlike a maximum of floats, one of integers vectorises.
float greatest_magnitude(std::span<const float> values) {
    std::uint32_t greatest = 0;
    for (const float value : values)
        greatest = std::max(greatest, std::bit_cast<std::uint32_t>(value) & 0x7fffffffU);
    return std::bit_cast<float>(greatest);
}

}  // namespace

float brightest_pixel(const Ping& ping, std::string_view sensor, std::uint32_t pose) {
    const float brightest = greatest_magnitude(ping.intensity);
    if (std::isfinite(brightest)) return brightest;
    const auto faulty =
        std::ranges::count_if(ping.intensity, [](float v) { return !std::isfinite(v); });
    throw std::runtime_error("sensor '" + std::string(sensor) + "', ping at pose " +
                             std::to_string(pose) + ": " + std::to_string(faulty) + " of " +
                             std::to_string(ping.intensity.size()) +
                             " pixels are NaN or infinite, a fault of sonarsim; please report it "
                             "with the mission");
}

}  // namespace sonarsim
