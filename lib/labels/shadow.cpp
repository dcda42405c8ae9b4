#include "labels/shadow.h"

#include <algorithm>
#include <cmath>

#include "labels/sight_lines.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// A sight line ends after this many surfaces: four closed bodies one behind the other.
constexpr int most_surfaces_behind = 8;

// The gap behind a surface at which a sight line continues, as a share of its range: well above the
// rounding of floats and far below a bin.
constexpr float step_behind = 1e-5F;

/// An object that a sight line has met, and the node before it. The first one of a way is its own.
struct WayNode {
    std::uint32_t object, before;
};

/// True if the way that ends in a node has met an object.
bool has_met(const std::vector<WayNode>& nodes, std::uint32_t node, std::uint32_t object) {
    while (nodes[node].object != object && nodes[node].before != node)
        node = nodes[node].before;
    return nodes[node].object == object;
}

/// Gives each 0 the value that stands nearest to it; of two the lower one. False: all are 0.
bool fill_gaps(std::span<std::uint16_t> ids) {
    const auto count = static_cast<int>(ids.size());
    int before = -1;
    for (int i = 0; i <= count; ++i) {
        if (i < count && ids[i] == 0) continue;
        if (i == count && before < 0) return false;
        for (int k = before + 1; k < i; ++k) {
            const bool lower = before >= 0 && (i == count || k - before <= i - k);
            ids[k] = ids[lower ? before : i];
        }
        before = i;
    }
    return true;
}

/// The ray that goes on behind the end of a sight line, from the pose of transmission.
Ray ray_behind(const SightLine& line, const PingMotion& motion, ViewShape shape) {
    if (motion.is_still())
        return {line.direction * (line.range_m * (1.0F + step_behind)), line.direction};
    const Eigen::Vector3d measured = (line.range_m * line.direction).cast<double>();
    const Eigen::Vector3f place = unmoved_place(motion, shape, measured).cast<float>();
    return {place * (1.0F + step_behind), place.normalized()};
}

}  // namespace

ShadowFinder::ShadowFinder(const TracedPing& traced, const ConeBeams& cones, const View& view,
                           const SceneObjects& objects, const VisibilityEngine& engine,
                           const ObjectDirections& directions, Of of, Behind& behind)
    : bins_(range_bins(view)), follows_objects_(of == Of::annotated) {
    const bool annotated = of == Of::annotated;
    std::vector<SightLine> lines = sight_lines(traced, cones, view.beams);
    const std::size_t count = lines.size();
    std::vector<WayNode> nodes;
    nodes.reserve(lines.size());
    solid_angles_.resize(objects.objects.size());
    for (const SightLine& line : lines) {
        nodes.push_back({objects.object_of(line.sample->instance), line.first});
        solid_angles_[nodes.back().object].visible += line.solid_angle;
    }
    const auto is_shadow = [&](const SightLine& line) {
        return !annotated || !objects.is_background(nodes[line.first].object);
    };
    const auto is_wanted = [&](const SightLine& line) {
        if (directions.is_empty_behind(line.direction, line.range_m)) return false;
        return is_shadow(line) || directions.may_lie_behind(line.direction, line.range_m);
    };
    std::erase_if(lines, [&](const SightLine& line) { return !is_wanted(line); });
    std::vector<Ray> rays;
    std::vector<Intersection> met;
    const auto range_max = static_cast<float>(view.range_max_m);
    for (int layer = 0; layer < most_surfaces_behind && !lines.empty(); ++layer) {
        met.resize(lines.size());
        if (annotated && !behind.empty()) {
            for (std::size_t k = 0; k < lines.size(); ++k)
                met[k] = behind[layer][lines[k].first];
        } else {
            rays.clear();
            for (const SightLine& line : lines)
                rays.push_back(ray_behind(line, traced.motion, view.shape));
            engine.intersect_behind(traced.T_world_sensor, rays, range_max, met);
        }
        if (!annotated) {
            std::vector<Intersection>& own = behind.emplace_back(count);
            for (std::size_t k = 0; k < lines.size(); ++k)
                own[lines[k].first] = met[k];
        }
        std::size_t going_on = 0;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            SightLine line = lines[k];
            line.range_m = line.range_m * (1.0F + step_behind) + met[k].distance_m;
            if (!(line.range_m < range_max)) continue;
            if (is_shadow(line)) {
                const Hidden hidden{line.beam, nodes[line.first].object, line.range_m,
                                    half_extent(line, line.range_m, met[k].normal),
                                    line.solid_angle};
                cones.exist() ? add_to_cones(line, hidden, met[k].normal, cones)
                              : hidden_.push_back(hidden);
            }
            const std::uint32_t object = objects.object_of(met[k].instance);
            if (!has_met(nodes, line.passed, object)) {
                solid_angles_[object].hidden += line.solid_angle;
                nodes.push_back({object, line.passed});
                line.passed = static_cast<std::uint32_t>(nodes.size() - 1);
            }
            if (is_wanted(line)) lines[going_on++] = line;
        }
        lines.resize(going_on);
    }
    sort_into_beams(view.beams);
    owners_.resize(view.beams);
    if (!cones.exist() && !annotated) covered_ = engine.covered_bins(view, traced.T_world_sensor);
    if (covered_.empty()) covered_ = hidden_bins(view.beams);
}

void ShadowFinder::add_to_cones(const SightLine& line, const Hidden& whole,
                                const Eigen::Vector3f& normal, const ConeBeams& cones) {
    const Sample& sample = *line.sample;
    const int rows = beams_along(sample.edge_u, line, cones);
    const int columns = beams_along(sample.edge_v, line, cones);
    if (rows * columns == 1) return hidden_.push_back(whole);
    const auto share = 1.0F / static_cast<float>(rows * columns);
    const float least_m = whole.range_m - whole.half_m;
    const float greatest_m = whole.range_m + whole.half_m;
    const float along = normal.dot(line.direction);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const Eigen::Vector3f to =
                sample.position +
                ((2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(rows) - 1.0F) *
                    sample.edge_u +
                ((2.0F * static_cast<float>(j) + 1.0F) / static_cast<float>(columns) - 1.0F) *
                    sample.edge_v;
            const Eigen::Vector3f direction = arrival_of(to).direction;
            const int beam = cones.beam(direction.y());
            if (beam < 0) continue;
            Hidden piece = whole;
            piece.beam = static_cast<std::uint32_t>(beam);
            // The quotient may be no number for a plane that is seen edge-on; fmax() leaves that
            // out.
            const float range_m = whole.range_m * along / normal.dot(direction);
            piece.range_m = std::fmin(std::fmax(range_m, least_m), greatest_m);
            piece.half_m = whole.half_m / static_cast<float>(std::max(rows, columns));
            piece.solid_angle = whole.solid_angle * share;
            hidden_.push_back(piece);
        }
    }
}

std::vector<std::uint8_t> ShadowFinder::hidden_bins(int beams) const {
    std::vector<std::uint8_t> covered(static_cast<std::size_t>(beams) * bins_.count);
    const auto bin_at = [&](float range_m) {
        const float bin = (range_m - bins_.min_m) / bins_.bin_m;
        return static_cast<int>(std::clamp(bin, -1.0F, static_cast<float>(bins_.count)));
    };
    for (const Hidden& hidden : hidden_) {
        std::uint8_t* const own = &covered[static_cast<std::size_t>(hidden.beam) * bins_.count];
        const int first = std::max(bin_at(hidden.range_m - hidden.half_m), 0);
        const int last = std::min(bin_at(hidden.range_m + hidden.half_m), bins_.count - 1);
        for (int i = first; i <= last; ++i)
            own[i] = 1;
    }
    return covered;
}

void ShadowFinder::sort_into_beams(int beams) {
    beam_begin_.assign(beams + 1, 0);
    for (const Hidden& hidden : hidden_)
        ++beam_begin_[hidden.beam + 1];
    for (int j = 0; j < beams; ++j)
        beam_begin_[j + 1] += beam_begin_[j];
    std::vector<std::uint32_t> next = beam_begin_;
    places_.resize(hidden_.size());
    for (std::uint32_t k = 0; k < hidden_.size(); ++k)
        places_[next[hidden_[k].beam]++] = {hidden_[k].object, k};
}

std::vector<float> ShadowFinder::visible_shares() const {
    std::vector<float> shares;
    shares.reserve(solid_angles_.size());
    for (const SolidAngles& angles : solid_angles_)
        shares.push_back(static_cast<float>(angles.visible / (angles.visible + angles.hidden)));
    return shares;
}

std::vector<std::uint16_t>& ShadowFinder::owners(int j) {
    std::vector<std::uint16_t>& owners = owners_[j];
    if (owners.empty()) {
        owners.resize(bins_.count);
        find_owners(j, owners);
    }
    return owners;
}

void ShadowFinder::find_owners(int j, std::span<std::uint16_t> owners) {
    const auto own =
        std::span(places_).subspan(beam_begin_[j], beam_begin_[j + 1] - beam_begin_[j]);
    if (own.empty()) return;
    std::ranges::sort(own);
    shares_.clear(bins_.count);
    for (std::size_t a = 0, b = 0; a < own.size(); a = b) {
        while (b < own.size() && own[b].object == own[a].object)
            ++b;
        echoes_.resize(b - a);
        for (std::size_t k = a; k < b; ++k) {
            const Hidden& hidden = hidden_[own[k].at];
            echoes_.range_m[k - a] = hidden.range_m;
            echoes_.half_m[k - a] = hidden.half_m;
            echoes_.weight[k - a] = hidden.solid_angle;
            echoes_.intensity[k - a] = 1.0F;
        }
        const EchoRange all{0, static_cast<std::uint32_t>(echoes_.size())};
        shares_.add(own[a].object, echoes_, {&all, 1}, bins_);
    }
    finder_.find(
        shares_, Ranks::first, [](std::uint32_t object) { return object; }, strongest_);
    for (int i = strongest_.first; i < strongest_.last; ++i)
        owners[i] = static_cast<std::uint16_t>(strongest_.key[i]);
}

std::span<const std::uint16_t> ShadowFinder::nearest_owners(int j) {
    const auto beams = static_cast<int>(owners_.size());
    for (int away = 0; away < beams; ++away) {
        for (const int beam : {j - away, j + away}) {
            if (beam < 0 || beam >= beams) continue;
            if (fill_gaps(owners(beam))) return owners(beam);
        }
    }
    return owners(j);
}

void ShadowFinder::find(int j, std::span<const std::uint8_t> occupied,
                        std::span<std::uint16_t> shadow) {
    std::ranges::fill(shadow, 0);
    if (follows_objects_ && beam_begin_[j] == beam_begin_[j + 1]) return;
    const std::uint8_t* covered = &covered_[static_cast<std::size_t>(j) * bins_.count];
    bool dark = false;
    for (int i = 0; i < bins_.count; ++i)
        dark |= covered[i] > occupied[i];
    if (!dark || hidden_.empty()) return;
    std::span<const std::uint16_t> owner = owners(j);
    for (int i = 0; i < bins_.count; ++i) {
        if (covered[i] <= occupied[i]) continue;
        if (owner[i] == 0) owner = nearest_owners(j);
        if (owner[i] == 0) return;  // no line ends anywhere
        shadow[i] = owner[i];
    }
}

}  // namespace sonarsim
