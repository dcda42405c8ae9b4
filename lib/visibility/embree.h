#pragma once

// One view of Embree 3 (Debian 12) and Embree 4 (Debian 13). The build says which one it found.
#if SONARSIM_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <cmath>
#include <utility>

namespace sonarsim {

/// A tree of Embree's that goes with its owner.
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

/// Without what rounding has left of a zero. Embree sorts coherent rays into octants by the signs
/// of their components, but takes one that is nearer to zero than 1e-18 for +1e-18 where it divides
/// by it: all rays of the packet that share the octant of a ray with -1e-19 would meet nothing. A
/// ray is turned by 1e-9 at most, a micrometre in a kilometre; what is left of a product of two
/// numbers that pass stays above that limit.
inline float without_rest(float component) {
    constexpr float rest = 1e-9F;
    return std::fabs(component) < rest ? 0.0F : component;
}

/// rtcIntersect8 for rays that lie close together; the arguments are Embree's.
inline void intersect_coherent_8(const int* valid, RTCScene tree, RTCRayHit8& rays) {
#if SONARSIM_EMBREE == 3
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, tree, &context, &rays);
#else
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, tree, &rays, &arguments);
#endif
}

}  // namespace sonarsim
