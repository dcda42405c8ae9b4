#pragma once

#include "input/scene/objects.h"
#include "simulate/trace/bounce_path.h"
#include "simulate/trace/cone_beams.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Takes blocks of echoes. Samples stay during the call; with patches, as long as SurfaceEchoes.
using UseEchoes = std::function<void(const EchoBlock&)>;

/// Collects echoes into blocks and hands these on.
class EchoBlocks {
  public:
    explicit EchoBlocks(const UseEchoes& use) : use_(use) {}

    void add(std::uint32_t beam, float range_m, float half_m, float weight, float intensity,
             const Sample* sample, std::uint32_t second = no_instance) {
        if (block_.count == EchoBlock::capacity) flush();
        const int k = block_.count++;
        block_.beam[k] = beam;
        block_.range_m[k] = range_m;
        block_.half_m[k] = half_m;
        block_.weight[k] = weight;
        block_.intensity[k] = intensity;
        block_.sample[k] = sample;
        block_.second[k] = second;
    }
    void flush() {
        if (block_.count > 0) use_(block_);
        block_.count = 0;
    }
    /// The echoes from here on come through walls.
    void begin_behind_walls() {
        flush();
        block_.behind_walls = true;
    }
    /// The echoes from here on are multipath.
    void begin_multipath() {
        flush();
        block_.behind_walls = false;
        block_.multipath = true;
    }

  private:
    const UseEchoes& use_;
    EchoBlock block_;
};

/// The echo of a piece of visible surface in a beam.
struct PatchEcho {
    std::uint32_t beam;
    double echo;
};

/// A piece of visible surface, or of surface behind thin walls. Several beams may receive it.
struct EchoPatch {
    Eigen::Vector3f position, edge_u, edge_v;    ///< as in Sample
    std::uint32_t echo_begin = 0, echo_end = 0;  ///< its echoes in `patch_echoes`
    const Sample* sample;
    float wedge = 0.0F;  ///< as in Sample
};

/// The echoes and surface that labels need.
struct EchoRequest {
    bool patches = false;  ///< the visible surface, too
    /// Not null: only bins are needed in which one of these objects, background excepted, may have
    /// an echo or a shadow. The others may lack echoes.
    const SceneObjects* objects = nullptr;
};

/// The surface that labels need besides the echoes. The traced ping must outlive it.
struct SurfaceEchoes {
    SurfaceEchoes() = default;
    SurfaceEchoes(SurfaceEchoes&&) = default;  ///< a copy would point into the original

    /// The visible surface; empty unless it was requested.
    std::vector<EchoPatch> patches;
    std::vector<PatchEcho> patch_echoes;
    /// beams + 1 offsets into `patches` if sorted by beam with one echo each; else empty.
    std::vector<std::uint32_t> patch_begin;
    /// The beams of a line array; empty: those of the view.
    ConeBeams cones;
    /// 1 for the samples with a direct echo, 0 for those in side lobes; empty: all have one.
    std::vector<std::uint8_t> received;
};

}  // namespace sonarsim
