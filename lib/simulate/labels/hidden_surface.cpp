#include "simulate/labels/hidden_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

// A sight line ends after this many surfaces: four closed bodies one behind the other.
constexpr int max_surfaces_behind = 8;

// Gap behind a surface at which a sight line continues, as a share of its range.
constexpr float step_behind = 1e-5F;

/// An object that a sight line has met, and the node before it; of the first node, itself.
struct Occluder {
    std::uint32_t object, before;
};

/// True if the way that ends in a node has met an object.
bool has_met(const std::vector<Occluder>& nodes, std::uint32_t node, std::uint32_t object) {
    while (nodes[node].object != object && nodes[node].before != node)
        node = nodes[node].before;
    return nodes[node].object == object;
}

/// The solid angle of an object that sight lines meet, sr.
struct SolidAngles {
    double visible = 0.0, hidden = 0.0;
};

/// The ray that continues behind the end of a sight line, from the pose of transmission.
Ray ray_behind(const SightLine& line, const PingMotion& motion, ViewShape shape) {
    if (motion.is_still())
        return {line.direction * (line.range_m * (1.0F + step_behind)), line.direction};
    const Eigen::Vector3d measured = (line.range_m * line.direction).cast<double>();
    const Eigen::Vector3f place = unmoved_place(motion, shape, measured).cast<float>();
    return {place * (1.0F + step_behind), place.normalized()};
}

class LineTracer {
  public:
    LineTracer(const LineWidth& width, const SceneObjects& objects,
               const ObjectDirections& directions, HiddenSurface::By by)
        : width_(width),
          objects_(objects),
          directions_(directions),
          all_(by == HiddenSurface::By::all),
          range_max_m_(static_cast<float>(width.view.range_max_m)),
          solid_angles_(objects.objects.size()) {}

    /// Counts a line as visible. True if wanted surface may lie behind it.
    bool see(const SightLine& line) {
        solid_angles_[owner_of(line)].visible += line.solid_angle;
        return is_wanted(line);
    }

    /// True if an object hides what lies behind a line, not background.
    bool is_by_object(const SightLine& line) const {
        return !objects_.is_background(owner_of(line));
    }

    /// Notes the surface that a line has met. Returns its object.
    std::uint32_t pass(SightLine& line, const Intersection& met) const {
        const std::uint32_t object = objects_.object_of(met.instance);
        line.behind_background = line.behind_background || objects_.is_background(object);
        return object;
    }

    /// True if wanted surface may lie behind a line.
    bool is_wanted(const SightLine& line) const {
        return (is_shadow(line) || directions_.may_lie_behind(line.direction, line.range_m)) &&
               !directions_.is_empty_behind(line.direction, line.range_m);
    }

    void begin(std::vector<SightLine>& lines) {
        for (SightLine& line : lines) {
            line.last_node = static_cast<std::uint32_t>(nodes_.size());
            nodes_.push_back({owner_of(line), line.last_node});
        }
    }

    /// Records the surface that lines have met. Those that end there are removed.
    void advance(std::vector<SightLine>& lines, std::span<const Intersection> met) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            if (take(lines[k], met[k])) lines[kept++] = lines[k];
        }
        lines.resize(kept);
    }

    HiddenSurface finish() {
        drop_far_sides();
        HiddenSurface out{std::move(pieces_), {}};
        for (const SolidAngles& of : solid_angles_)
            out.visible_shares.push_back(static_cast<float>(of.visible / (of.visible + of.hidden)));
        return out;
    }

  private:
    /// A body's own far side is in a shadow only among other hidden surface of its beam.
    void drop_far_sides() {
        std::vector<Eigen::AlignedBox1f> others(width_.view.beams);
        const auto extent = [](const HiddenPiece& piece) {
            return Eigen::AlignedBox1f(Eigen::Matrix<float, 1, 1>(piece.range_m - piece.half_m),
                                       Eigen::Matrix<float, 1, 1>(piece.range_m + piece.half_m));
        };
        for (const HiddenPiece& piece : pieces_) {
            if (!piece.far_side) others[piece.beam].extend(extent(piece));
        }
        std::erase_if(pieces_, [&](const HiddenPiece& piece) {
            return piece.far_side && !others[piece.beam].intersects(extent(piece));
        });
    }

    /// Records the surface that a line has met. True if the line continues.
    bool take(SightLine& line, const Intersection& met) {
        line.range_m = line.range_m * (1.0F + step_behind) + met.distance_m;
        if (!(line.range_m < range_max_m_)) return false;
        const bool is_far_side =
            is_by_object(line) && owner_of(line) == objects_.object_of(met.instance);
        if (is_shadow(line)) {
            // Hidden surface lies behind what hides it, however far its plane extends.
            const float half_m = half_extent(line, line.range_m, met.normal, width_);
            const float near_m = std::max(line.range_m - half_m, line.before_m);
            const float far_m = line.range_m + half_m;
            const float each =
                line.solid_angle / static_cast<float>(line.last_beam - line.beam + 1);
            for (std::uint32_t beam = line.beam; beam <= line.last_beam; ++beam)
                pieces_.push_back({beam, owner_of(line), 0.5F * (near_m + far_m),
                                   0.5F * (far_m - near_m), each, line.behind_background,
                                   is_far_side});
        }
        const std::uint32_t object = pass(line, met);
        if (!has_met(nodes_, line.last_node, object)) {
            solid_angles_[object].hidden += line.solid_angle;
            nodes_.push_back({object, line.last_node});
            line.last_node = static_cast<std::uint32_t>(nodes_.size() - 1);
        }
        return is_wanted(line);
    }

    std::uint32_t owner_of(const SightLine& line) const {
        return objects_.object_of(line.sample->instance);
    }
    bool is_shadow(const SightLine& line) const {
        return all_ || (is_by_object(line) && !line.behind_background);
    }

    const LineWidth& width_;
    const SceneObjects& objects_;
    const ObjectDirections& directions_;
    bool all_;  ///< background hides surface, too
    float range_max_m_;
    std::vector<Occluder> nodes_;
    std::vector<SolidAngles> solid_angles_;  ///< indexed by object
    std::vector<HiddenPiece> pieces_;
};

/// The parts of lines. One line of a sample finds out how deep the surface behind it is, layer by
/// layer; behind the sample of a line array, only whether there is any.
template <class Cast>
std::vector<SightLine> divided_lines(std::span<const SightLine> whole, const LineWidth& width,
                                     const LineTracer& tracer, Cast cast) {
    const bool by_beams = width.cones.exist();
    std::vector<LineParts> parts(whole.size());
    std::vector<std::uint8_t> met_any(whole.size(), 0);
    std::vector<SightLine> lines(whole.begin(), whole.end());
    std::vector<std::size_t> number(whole.size());
    std::iota(number.begin(), number.end(), std::size_t{0});
    for (int layer = 0; layer < (by_beams ? 1 : max_surfaces_behind) && !lines.empty(); ++layer) {
        const std::span<const Intersection> met = cast(lines);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            SightLine& line = lines[k];
            const bool is_met = std::isfinite(met[k].distance_m);
            if (!is_met && (by_beams || line.behind_background)) continue;
            met_any[number[k]] = 1;
            if (by_beams || tracer.is_by_object(line)) {
                const LineParts these = parts_of(line, met[k], width);
                LineParts& all = parts[number[k]];
                all = {std::max(all.u, these.u), std::max(all.v, these.v)};
            }
            if (!is_met) continue;
            line.range_m = line.range_m * (1.0F + step_behind) + met[k].distance_m;
            tracer.pass(line, met[k]);
            if (!tracer.is_wanted(line)) continue;
            number[kept] = number[k];
            lines[kept++] = line;
        }
        lines.resize(kept);
    }
    std::vector<SightLine> out;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        if (met_any[k] == 0) continue;
        divide(
            whole[k], parts[k], width,
            [&](const SightLine& line) { return tracer.is_wanted(line); }, out);
    }
    return out;
}

}  // namespace

HiddenSurface find_hidden_surface(const TracedPing& traced, const SurfaceEchoes& echoes,
                                  const View& view, const SceneObjects& objects,
                                  const VisibilityEngine& engine,
                                  const ObjectDirections& directions, HiddenSurface::By by) {
    const LineWidth width{echoes.cones, view.guards.joined, view};
    LineTracer tracer(width, objects, directions, by);
    std::vector<Ray> rays;
    std::vector<Intersection> met;
    const auto cast = [&](std::span<const SightLine> lines) {
        met.resize(lines.size());
        rays.clear();
        for (const SightLine& line : lines)
            rays.push_back(ray_behind(line, traced.motion, view.shape));
        engine.intersect_behind(traced.T_world_sensor, rays, static_cast<float>(view.range_max_m),
                                met);
    };
    const std::vector<SightLine> whole = sight_lines(
        traced, echoes, view.beams, [&](const SightLine& line) { return tracer.see(line); });
    std::vector<SightLine> lines = divided_lines(whole, width, tracer, [&](const auto& some) {
        cast(some);
        return std::span<const Intersection>(met);
    });
    tracer.begin(lines);
    for (int layer = 0; layer < max_surfaces_behind && !lines.empty(); ++layer) {
        cast(lines);
        tracer.advance(lines, met);
    }
    return tracer.finish();
}

std::vector<std::uint8_t> hidden_bins(const std::vector<HiddenPiece>& pieces, const RangeBins& bins,
                                      int beams) {
    std::vector<std::uint8_t> covered(static_cast<std::size_t>(beams) * bins.count);
    const auto bin_at = [&](float range_m) {
        const float bin = std::floor((range_m - bins.min_m) / bins.bin_m);
        return static_cast<int>(std::clamp(bin, -1.0F, static_cast<float>(bins.count)));
    };
    for (const HiddenPiece& hidden : pieces) {
        std::uint8_t* const own = &covered[static_cast<std::size_t>(hidden.beam) * bins.count];
        const int first = std::max(bin_at(hidden.range_m - hidden.half_m), 0);
        const int last = std::min(bin_at(hidden.range_m + hidden.half_m), bins.count - 1);
        for (int i = first; i <= last; ++i)
            own[i] = 1;
    }
    return covered;
}

}  // namespace sonarsim
