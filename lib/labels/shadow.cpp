#include "labels/shadow.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

// A sight line through more surfaces than these is given up: four closed bodies one behind the
// other.
constexpr int most_surfaces_behind = 8;

// Where a sight line goes on behind a surface, as a share of its range: well above the rounding of
// floats and far below a bin.
constexpr float step_behind = 1e-5F;

// Surface seen along its plane covers all ranges: it is spread over this share of its range at
// most.
constexpr float longest_half = 0.1F;

/// A sight line on its way.
struct SightLine {
    std::uint32_t sample;
    std::uint32_t beam;
    float range_m;         ///< how far it has come
    std::uint32_t passed;  ///< the last node of its way
};

/// An object that a sight line has met, and the node before it. The first one of a way is its own.
struct WayNode {
    std::uint32_t object, before;
};

/// Whether the way that ends in a node has met an object.
bool has_met(const std::vector<WayNode>& nodes, std::uint32_t node, std::uint32_t object) {
    while (nodes[node].object != object && nodes[node].before != node)
        node = nodes[node].before;
    return nodes[node].object == object;
}

/// That a sample stands for, sr.
float solid_angle_of(const Sample& sample) {
    const float range = sample.position.norm();
    return sample.area_m2 * sample.height_m / (range * range * range);
}

std::vector<SightLine> sight_lines(const Samples& samples, int beams) {
    std::vector<SightLine> lines;
    lines.reserve(samples.items.size());
    for (int j = 0; j < beams; ++j) {
        for (std::uint32_t k = samples.beam_begin[j]; k < samples.beam_begin[j + 1]; ++k) {
            const float range = samples.items[k].position.norm();
            lines.push_back({k, static_cast<std::uint32_t>(j), range, k});
        }
    }
    return lines;
}

/// By how much the range of a plane changes along the half edge of the footprint before it.
float range_along(const Eigen::Vector3f& edge, const Eigen::Vector3f& direction, float before_m,
                  const Eigen::Vector3f& normal, float range_m) {
    const Eigen::Vector3f turn = (edge - direction * direction.dot(edge)) / before_m;
    return std::fabs(range_m * normal.dot(turn) / normal.dot(direction));
}

}  // namespace

void ShadowFinder::add(const Sample& sample, std::uint32_t beam, std::uint32_t object,
                       float range_m, const Eigen::Vector3f& normal) {
    const float before = sample.position.norm();
    const Eigen::Vector3f direction = sample.position / before;
    const float half = range_along(sample.edge_u, direction, before, normal, range_m) +
                       range_along(sample.edge_v, direction, before, normal, range_m);
    const float most = longest_half * range_m;
    // Of a plane seen edge-on the quotient may be no number.
    const float half_m = half < most ? half : most;
    hidden_.push_back({beam, object, range_m, half_m, solid_angle_of(sample)});
}

ShadowFinder::ShadowFinder(const TracedPing& traced, const View& view, const SceneObjects& objects,
                           const VisibilityEngine& engine, bool on)
    : bins_(range_bins(view)) {
    if (!on) return;
    const Samples& samples = traced.samples;
    std::vector<SightLine> lines = sight_lines(samples, view.beams);
    std::vector<WayNode> nodes;
    nodes.reserve(samples.items.size());
    solid_angles_.resize(objects.objects.size());
    for (std::uint32_t k = 0; k < samples.items.size(); ++k) {
        nodes.push_back({objects.object_of(samples.items[k].instance), k});
        solid_angles_[nodes[k].object].visible += solid_angle_of(samples.items[k]);
    }
    std::vector<Ray> rays;
    std::vector<Intersection> met;
    const auto range_max = static_cast<float>(view.range_max_m);
    for (int layer = 0; layer < most_surfaces_behind && !lines.empty(); ++layer) {
        rays.clear();
        for (const SightLine& line : lines) {
            const Eigen::Vector3f& at = samples.items[line.sample].position;
            const Eigen::Vector3f direction = at / at.norm();
            rays.push_back({direction * (line.range_m * (1.0F + step_behind)), direction});
        }
        met.resize(rays.size());
        engine.intersect(traced.T_world_sensor, rays, met);
        std::vector<SightLine> next;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            const float range = lines[k].range_m * (1.0F + step_behind) + met[k].distance_m;
            if (!(range < range_max)) continue;
            const Sample& sample = samples.items[lines[k].sample];
            add(sample, lines[k].beam, objects.object_of(sample.instance), range, met[k].normal);
            const std::uint32_t object = objects.object_of(met[k].instance);
            std::uint32_t node = lines[k].passed;
            if (!has_met(nodes, node, object)) {
                solid_angles_[object].hidden += solid_angle_of(sample);
                nodes.push_back({object, node});
                node = static_cast<std::uint32_t>(nodes.size() - 1);
            }
            next.push_back({lines[k].sample, lines[k].beam, range, node});
        }
        lines = std::move(next);
    }
    std::ranges::stable_sort(hidden_, [](const Hidden& a, const Hidden& b) {
        return a.beam != b.beam ? a.beam < b.beam : a.object < b.object;
    });
    std::uint32_t k = 0;
    for (int j = 0; j <= view.beams; ++j) {
        while (k < hidden_.size() && hidden_[k].beam < static_cast<std::uint32_t>(j))
            ++k;
        beam_begin_.push_back(k);
    }
}

std::vector<float> ShadowFinder::visible_shares() const {
    std::vector<float> shares;
    shares.reserve(solid_angles_.size());
    for (const SolidAngles& angles : solid_angles_)
        shares.push_back(static_cast<float>(angles.visible / (angles.visible + angles.hidden)));
    return shares;
}

void ShadowFinder::find(int j, std::span<const float> visible, std::span<std::uint16_t> shadow) {
    std::ranges::fill(shadow, 0);
    const std::uint32_t end = beam_begin_[j + 1];
    if (beam_begin_[j] == end) return;
    shares_.clear(bins_.count);
    for (std::uint32_t a = beam_begin_[j], b = a; a < end; a = b) {
        while (b < end && hidden_[b].object == hidden_[a].object)
            ++b;
        echoes_.resize(b - a, false);
        for (std::uint32_t k = a; k < b; ++k) {
            echoes_.range_m[k - a] = hidden_[k].range_m;
            echoes_.half_m[k - a] = hidden_[k].half_m;
            echoes_.weight[k - a] = hidden_[k].solid_angle;
            echoes_.intensity[k - a] = 1.0F;
        }
        shares_.add(hidden_[a].object, echoes_, 0, echoes_.size(), bins_);
    }
    finder_.find(
        shares_, [](std::uint32_t object) { return object; }, strongest_);
    for (int i = strongest_.first; i < strongest_.last; ++i) {
        if (visible[i] > 0.0F) continue;
        shadow[i] = static_cast<std::uint16_t>(strongest_.key[i]);
    }
}

}  // namespace sonarsim
