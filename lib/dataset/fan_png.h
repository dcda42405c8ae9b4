#pragma once

#include <optional>
#include <string>

#include "mission/mission.h"
#include "product/fan.h"
#include "product/fan_style.h"

namespace sonarsim {

/// Draws the fans of a sonar into PNG files as output.fan_style says: in grey by default, else in
/// RGB.
struct FanPng {
    FanMap map;
    std::optional<FanStyle> style;
};

FanPng make_fan_png(const Sonar& sonar, const OutputConfig& output);

std::string fan_png_bytes(const FanPng& png, const Ping& ping, double full_scale);

/// The largest size of such a file, bytes.
double fan_png_bytes_at_most(const FanPng& png);

}  // namespace sonarsim
