#pragma once

#include <cstdint>
#include <vector>

#include "ping/form_image.h"
#include "scene/objects.h"
#include "scene/placing/bottom.h"

namespace sonarsim {

/// What is to be told of a ping's bins.
struct LabelRequest {
    bool objects = false;
    bool shares = false;  ///< with the objects: share, second, second_share and multipath
    bool classes = false;
    bool materials = false;
    bool elevation = false;
    bool shadow = false;
    bool height = false;
    const Bottom* bottom = nullptr;  ///< that heights are above; null: nothing has one
};

/// What is in the bins of one ping, [beams, range_bins], beam after beam. Ids are 1 + the index
/// into SceneObjects::objects, its classes or Scene::materials; 0 is none. What was not asked for
/// is empty.
struct PingLabels {
    int range_bins = 0;
    int beams = 0;
    std::vector<std::uint16_t> object;  ///< that gives most of the bin's echo
    std::vector<float> share;           ///< of that echo; 0 where there is none
    std::vector<std::uint16_t> second;  ///< the object that gives most of the rest
    std::vector<float> second_share;
    std::vector<std::uint16_t> class_id;      ///< the class that gives most of the echo
    std::vector<std::uint16_t> material;      ///< likewise
    std::vector<float> multipath;             ///< share of the echo that came by a second surface
    std::vector<float> elevation_rad;         ///< of the visible surface; NaN where there is none
    std::vector<float> elevation_spread_rad;  ///< its standard deviation within the bin, likewise
    std::vector<float> height_m;              ///< above the bottom; NaN where there is none
    std::vector<std::uint16_t> shadow;        ///< what hides the surface of a bin that shows none
    /// With the shadow, by object: what is seen of its solid angle; NaN for one out of view.
    std::vector<float> visible_share;

    std::size_t size() const { return static_cast<std::size_t>(range_bins) * beams; }
};

/// Tells of every bin of a traced ping where its echo comes from, without noise: echoes are those
/// of form_image() without its random terms, spread over the bins in the same way, and count by
/// area times intensity, the numerator of Eq. 9. A multipath echo counts for the surface that it
/// left first. A pure function of its arguments; one ping on one thread.
PingLabels label_ping(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                      const SceneObjects& objects, const VisibilityEngine& engine,
                      const LabelRequest& request);

}  // namespace sonarsim
