#pragma once

// One view of Embree 3 (Debian 12) and Embree 4 (Debian 13). The build says which one it found.
#if SONARSIM_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

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
