#pragma once

#include "input/scene/objects.h"
#include "input/scene/placing/bottom.h"
#include "simulate/labels/object_directions.h"
#include "simulate/ping/sonar.h"
#include "simulate/visibility/clusters_in_view.h"

namespace sonarsim {

struct LabelRequest {
    bool objects = false;
    /// Needs objects: bins without an object or its shadow may have none, not even background.
    bool only_objects = false;
    bool shares = false;  ///< needs objects: share, second, second_share and multipath
    bool classes = false;
    bool materials = false;
    bool elevation = false;
    bool shadow = false;
    bool height = false;
    /// Needs objects: visible_object, visible_echo, own_object, own_echo, whole_echo.
    bool outlines = false;
    /// Needs objects: the data of annotations, for objects that are no background.
    bool annotations = false;
    std::span<const ObjectSphere> annotated = {};  ///< spheres around the annotated objects
    /// A box around all surface, world; null: not known, which only slows shadows down.
    const Eigen::AlignedBox3d* surface = nullptr;
    /// The triangles of the scene, for shadows; null: they are sorted in each ping.
    const SceneClusters* triangles = nullptr;
    const Bottom* bottom = nullptr;  ///< reference of heights; null: nothing has a height
};

/// The labels of the bins of one ping, [beams, range_bins], beam after beam. Ids are 1 + the index
/// into SceneObjects::objects, its classes or Scene::materials; 0 is none. Others are empty.
struct PingLabels {
    int range_bins = 0;
    int beams = 0;
    std::vector<std::uint16_t> object;  ///< the object that gives most of the bin's echo
    std::vector<float> share;           ///< its share of that echo; 0 without an echo
    std::vector<std::uint16_t> second;  ///< the object that gives most of the rest
    std::vector<float> second_share;
    /// For outlines, of the objects that are no background: that with the largest
    /// direct echo, and this echo; that with the largest echo of its own, which is direct or came
    /// over it on one of two surfaces; this echo, and all echoes.
    std::vector<std::uint16_t> visible_object, own_object;
    std::vector<float> visible_echo, own_echo, whole_echo;
    std::vector<std::uint16_t> silhouette;    ///< outlines; label_ping() leaves it empty
    std::vector<std::uint16_t> class_id;      ///< the class that gives most of the echo
    std::vector<std::uint16_t> material;      ///< the material that gives most of it
    std::vector<float> multipath;             ///< share of the echo that came over a second surface
    std::vector<float> elevation_rad;         ///< mean of the visible surface; NaN without any
    std::vector<float> elevation_spread_rad;  ///< its standard deviation within the bin
    std::vector<float> height_m;              ///< above the bottom; NaN where there is none
    std::vector<std::uint16_t> shadow;        ///< the object that hides the bin's surface
    /// For annotations: as `shadow`, but only objects that are no background hide.
    std::vector<std::uint16_t> object_shadow;
    /// With the shadow or for annotations, by object: the visible share of its solid angle; NaN for
    /// an object out of view and, without the shadow, for background.
    std::vector<float> visible_share;

    /// The objects of the bins for their facts: outlines if they are known.
    const std::vector<std::uint16_t>& facts() const {
        return silhouette.empty() ? object : silhouette;
    }
    std::size_t size() const { return static_cast<std::size_t>(range_bins) * beams; }
};

/// Calls use(member, wanted, blank) for every label of the bins: its member of PingLabels, whether
/// a request needs it, and its value in a bin without any.
template <class Use>
void for_each_label(const LabelRequest& request, Use use) {
    constexpr std::uint16_t no_id = 0;
    constexpr float nothing = 0.0F;
    constexpr float no_surface = std::numeric_limits<float>::quiet_NaN();
    use(&PingLabels::object, request.objects, no_id);
    use(&PingLabels::share, request.shares, nothing);
    use(&PingLabels::second, request.shares, no_id);
    use(&PingLabels::second_share, request.shares, nothing);
    use(&PingLabels::multipath, request.shares, nothing);
    use(&PingLabels::visible_object, request.outlines, no_id);
    use(&PingLabels::visible_echo, request.outlines, nothing);
    use(&PingLabels::own_object, request.outlines, no_id);
    use(&PingLabels::own_echo, request.outlines, nothing);
    use(&PingLabels::whole_echo, request.outlines, nothing);
    use(&PingLabels::class_id, request.classes, no_id);
    use(&PingLabels::material, request.materials, no_id);
    use(&PingLabels::elevation_rad, request.elevation, no_surface);
    use(&PingLabels::elevation_spread_rad, request.elevation, no_surface);
    use(&PingLabels::height_m, request.height, no_surface);
    use(&PingLabels::shadow, request.shadow, no_id);
    use(&PingLabels::object_shadow, request.annotations, no_id);
}

/// Finds the origin of the echo of every bin of a traced ping, without noise: the echoes are those
/// of EchoModel::surface_echoes(). A multipath echo counts for the specular surface. A pure
/// function of its arguments; one ping on one thread.
PingLabels label_ping(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                      const SceneObjects& objects, const VisibilityEngine& engine,
                      const LabelRequest& request);

/// Fills the elevations and heights for which there is room. The bins that a patch covers are
/// computed once for both. Without a `bottom` nothing has a height. `is_bottom`: that of the scene.
void label_patches(const SurfaceEchoes& echoes, const View& view, const TruePlaces& places,
                   const Bottom* bottom, std::span<const std::uint8_t> is_bottom,
                   PingLabels& labels);

}  // namespace sonarsim
