#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dataset/assemble.h"
#include "dataset/layout.h"
#include "mission/mission.h"
#include "ping/ping.h"
#include "product/fan.h"

namespace sonarsim {

/// The files of one ping in memory, in the order in which they are to be written.
struct PingFiles {
    std::vector<std::pair<FileKind, std::string>> files;
    std::uint64_t clipped_pixels = 0;  ///< intensities above full_scale; white in the images
};

/// round(65535 intensity / full_scale), white above full_scale.
std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale);

/// One map per sonar; empty where neither fans nor stages are asked for.
std::vector<FanMap> make_fan_maps(const Mission& mission, const Assembly& assembly,
                                  const Layout& layout);

/// Encodes a ping into the kinds of file that `layout` asks for. `fans` are those of
/// make_fan_maps(). `measured` goes into the metadata. `stages` are those of
/// form_stages(), or nothing when they are not asked for.
PingFiles encode_ping(const Mission& mission, const Assembly& assembly, const Layout& layout,
                      const std::vector<FanMap>& fans, const PingId& id, const Ping& ping,
                      const nlohmann::ordered_json& measured = {},
                      std::span<const Ping> stages = {});

}  // namespace sonarsim
