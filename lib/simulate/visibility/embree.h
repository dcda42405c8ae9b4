#pragma once

// One interface to Embree 3 (Debian 12) and Embree 4 (Debian 13). The build defines which it found.
#if SONARSIM_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <cmath>
#include <utility>

namespace sonarsim {

/// Owns an Embree tree.
class EmbreeTree {
  public:
    explicit EmbreeTree(RTCDevice device) : scene_(rtcNewScene(device)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    }
    ~EmbreeTree() {
        if (scene_) rtcReleaseScene(scene_);
    }
    EmbreeTree(EmbreeTree&& other) noexcept : scene_(std::exchange(other.scene_, nullptr)) {}
    EmbreeTree(const EmbreeTree&) = delete;
    EmbreeTree& operator=(const EmbreeTree&) = delete;

    RTCScene get() const { return scene_; }

  private:
    RTCScene scene_;
};

/// Sets components that are rounding errors of zero to 0. Embree sorts coherent rays into octants
/// by the signs of their components, but replaces a component nearer to zero than 1e-18 by +1e-18
/// where it divides: all rays of the packet in the octant of a ray with -1e-19 would meet nothing.
/// This turns a ray by at most 1e-9. Products of two components that pass stay above the limit.
inline float flush_to_zero(float component) {
    constexpr float rest = 1e-9F;
    return std::fabs(component) < rest ? 0.0F : component;
}

/// rtcIntersect8 or, if `any_hit`, rtcOccluded8 of a whole packet. Filters get `context`.
#if SONARSIM_EMBREE == 3
using QueryContext = RTCIntersectContext;

inline void trace_8(const int* valid, RTCScene tree, bool any_hit, RTCRayHit8& rays,
                    QueryContext& context) {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (any_hit) return rtcOccluded8(valid, tree, &context, &rays.ray);
    rtcIntersect8(valid, tree, &context, &rays);
}
#else
using QueryContext = RTCRayQueryContext;

inline void trace_8(const int* valid, RTCScene tree, bool any_hit, RTCRayHit8& rays,
                    QueryContext& context) {
    rtcInitRayQueryContext(&context);
    const auto set = [&](auto& arguments) {
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        arguments.context = &context;
    };
    RTCOccludedArguments any;
    RTCIntersectArguments nearest;
    rtcInitOccludedArguments(&any);
    rtcInitIntersectArguments(&nearest);
    set(any);
    set(nearest);
    if (any_hit) return rtcOccluded8(valid, tree, &rays.ray, &any);
    rtcIntersect8(valid, tree, &rays, &nearest);
}
#endif

}  // namespace sonarsim
