#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "trace/surface_echoes.h"

namespace sonarsim {

/// The echo of a piece of surface in a beam.
struct FoundEcho {
    std::uint32_t beam;
    float range_m, half_m, power;
    const Sample* sample;
};

/// The echoes sorted by beam; those of a beam keep their order.
inline BeamEchoes by_beam(const std::vector<FoundEcho>& found, int beams) {
    BeamEchoes out;
    out.beam_begin.resize(static_cast<std::size_t>(beams) + 1);
    for (const FoundEcho& echo : found)
        ++out.beam_begin[echo.beam + 1];
    std::partial_sum(out.beam_begin.begin(), out.beam_begin.end(), out.beam_begin.begin());
    std::vector<std::uint32_t> next = out.beam_begin;
    out.boxes.resize(found.size());
    out.sample.resize(found.size());
    std::ranges::fill(out.boxes.intensity, 1.0F);
    for (const FoundEcho& echo : found) {
        const std::uint32_t k = next[echo.beam]++;
        out.boxes.range_m[k] = echo.range_m;
        out.boxes.half_m[k] = echo.half_m;
        out.boxes.weight[k] = echo.power;
        out.sample[k] = echo.sample;
    }
    return out;
}

}  // namespace sonarsim
