#include "simulate/labels/hidden_surface.h"

#include <cmath>
#include <utility>

#include "simulate/trace/visible_water_surface.h"

namespace sonarsim {

namespace {

// Gap behind a surface at which a sight line continues, as a share of its range.
constexpr float step_behind = 1e-5F;

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
          solid_angles_(objects.objects.size()) {}

    /// Counts a line as visible. True if wanted surface may lie behind it.
    bool see(const SightLine& line) {
        solid_angles_[owner_of(line)].visible += line.solid_angle;
        return is_wanted(line) || std::isfinite(least_size(line));
    }

    /// True if an object may lie behind a line.
    bool is_before_object(const SightLine& line) const {
        return directions_.may_lie_behind(line.direction, line.range_m) &&
               !directions_.is_empty_behind(line.direction, line.range_m);
    }

    /// The least size of the objects that may lie behind some of a line; infinite: none.
    float least_size(const SightLine& line) const {
        float least = std::numeric_limits<float>::infinity();
        const auto look = [&](const Eigen::Vector3f& edge, float share) {
            const Eigen::Vector3f towards = line.direction + share / line.before_m * edge;
            if (directions_.may_lie_behind(towards, line.before_m))
                least = std::min(least, directions_.least_size(towards));
        };
        const Sample& sample = *line.sample;
        look(sample.edge_u, 0.0F);
        for (const float share : {1.0F, -1.0F}) {
            look(sample.edge_u, share);
            look(sample.edge_v, share);
        }
        return least;
    }

    /// True if an object hides what lies behind a line, not background.
    bool is_by_object(const SightLine& line) const {
        return !objects_.is_background(owner_of(line));
    }

    /// Continues a line behind a surface that it has met. Returns the object of that surface.
    std::uint32_t pass(SightLine& line, const Intersection& met) const {
        const std::uint32_t object = objects_.object_of(met.instance);
        line.range_m = line.before_m * (1.0F + step_behind) + met.distance_m;
        line.behind_background = line.behind_background || objects_.is_background(object);
        return object;
    }

    /// True if hidden surface that is wanted may lie behind a line.
    bool is_wanted(const SightLine& line) const {
        return is_shadow(line) && !directions_.is_empty_behind(line.direction, line.range_m);
    }

    /// Records the surfaces that a line meets, as far as they are wanted.
    void record(SightLine line, std::span<const Intersection> surfaces) {
        for (const Intersection& met : surfaces) {
            if (!take(line, met)) return;
        }
    }

    /// Counts the objects behind a line as hidden.
    void count_hidden(const SightLine& line, std::span<const Intersection> surfaces) {
        met_.assign(1, owner_of(line));
        for (const Intersection& met : surfaces) {
            const std::uint32_t object = objects_.object_of(met.instance);
            if (std::ranges::find(met_, object) != met_.end()) continue;
            solid_angles_[object].hidden += line.solid_angle;
            met_.push_back(object);
        }
    }

    HiddenSurface finish() {
        HiddenSurface out{std::move(pieces_), {}};
        for (const SolidAngles& of : solid_angles_)
            out.visible_shares.push_back(static_cast<float>(of.visible / (of.visible + of.hidden)));
        return out;
    }

  private:
    /// Records the surface that a line has met. True if the line continues.
    bool take(SightLine& line, const Intersection& met) {
        const bool was_shadow = is_shadow(line);
        const bool was_behind = line.behind_background;
        const std::uint32_t object = pass(line, met);
        const bool is_far_side = is_by_object(line) && owner_of(line) == object;
        if (was_shadow) {
            // Hidden surface lies behind what hides it, however far its plane extends.
            const float half_m = half_extent(line, line.range_m, met.normal, width_);
            const float near_m = std::max(line.range_m - half_m, line.before_m);
            const float far_m = line.range_m + half_m;
            const float each =
                line.solid_angle / static_cast<float>(line.last_beam - line.beam + 1);
            for (std::uint32_t beam = line.beam; beam <= line.last_beam; ++beam)
                pieces_.push_back({beam, owner_of(line), 0.5F * (near_m + far_m),
                                   0.5F * (far_m - near_m), each, was_behind, is_far_side});
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
    bool all_;                               ///< background hides surface, too
    std::vector<std::uint32_t> met_;         ///< the objects that the line has met
    std::vector<SolidAngles> solid_angles_;  ///< indexed by object
    std::vector<HiddenPiece> pieces_;
};

/// The parts for a line that meets these surfaces: no piece of them is deeper than a few bins.
LineParts parts_by_surfaces(SightLine line, std::span<const Intersection> surfaces,
                            const LineWidth& width, const LineTracer& tracer) {
    LineParts all;
    for (std::size_t i = 0; i <= surfaces.size(); ++i) {
        const Intersection* const met = i < surfaces.size() ? &surfaces[i] : nullptr;
        if (!met && line.behind_background) break;
        const LineParts these =
            tracer.is_by_object(line) ? parts_of(line, met, width) : LineParts{};
        all = {std::max(all.u, these.u), std::max(all.v, these.v)};
        if (met) tracer.pass(line, *met);
        // The facts of objects are the same if the shadows of background are wanted, too.
        if (line.behind_background || !tracer.is_wanted(line)) break;
    }
    return all;
}

}  // namespace

HiddenSurface find_hidden_surface(const TracedPing& traced, const SurfaceEchoes& echoes,
                                  const TraceContext& context, const SceneObjects& objects,
                                  const ObjectDirections& directions, HiddenSurface::By by) {
    const View& view = context.view;
    const LineWidth width{echoes.cones, view.guards.joined, view};
    LineTracer tracer(width, objects, directions, by);
    const std::optional<WaterMirror> water =
        mirror_of(context.scene.water_surface, context.T_world_sensor);
    const auto pass = [&](std::span<const SightLine> lines, const UseSurfaces& use) {
        std::vector<Ray> rays;
        for (const SightLine& line : lines)
            rays.push_back(ray_behind(line, traced.motion, view.shape));
        // Sound from below does not arrive above the water's surface.
        const auto use_below = [&](std::size_t k, std::span<const Intersection> met) {
            const float end_m =
                water ? water->distance(rays[k]) : std::numeric_limits<float>::infinity();
            const auto end = std::ranges::find_if(
                met, [&](const Intersection& one) { return one.distance_m > end_m; });
            use(k, met.first(static_cast<std::size_t>(end - met.begin())));
        };
        context.engine.pass_surfaces(context.T_world_sensor, rays,
                                     static_cast<float>(view.range_max_m), use_below);
    };
    std::vector<SightLine> whole = sight_lines(
        traced, echoes, view.beams, [&](const SightLine& line) { return tracer.see(line); });
    // The shares of objects have lines of their own.
    std::vector<SightLine> lines;
    for (const SightLine& line : whole) {
        const auto keep = [&](const SightLine& part) { return tracer.is_before_object(part); };
        if (const float size = tracer.least_size(line); std::isfinite(size))
            divide(line, parts_of_share(line, view, size), width, keep, lines);
    }
    pass(lines, [&](std::size_t k, std::span<const Intersection> surfaces) {
        tracer.count_hidden(lines[k], surfaces);
    });
    lines.clear();
    std::erase_if(whole, [&](const SightLine& line) { return !tracer.is_wanted(line); });
    const auto divide_one = [&](const SightLine& line, const LineParts& parts) {
        const auto keep = [&](const SightLine& part) { return tracer.is_wanted(part); };
        divide(line, parts, width, keep, lines);
    };
    if (echoes.cones.exist()) {
        for (const SightLine& line : whole)
            divide_one(line,
                       tracer.is_by_object(line) ? parts_of(line, nullptr, width) : LineParts{});
    } else {
        pass(whole, [&](std::size_t k, std::span<const Intersection> surfaces) {
            divide_one(whole[k], parts_by_surfaces(whole[k], surfaces, width, tracer));
        });
    }
    pass(lines, [&](std::size_t k, std::span<const Intersection> surfaces) {
        tracer.record(lines[k], surfaces);
    });
    return tracer.finish();
}

void drop_far_sides(std::vector<HiddenPiece>& pieces, int beams) {
    std::vector<Eigen::AlignedBox1f> others(beams);
    const auto extent = [](const HiddenPiece& piece) {
        return Eigen::AlignedBox1f(Eigen::Matrix<float, 1, 1>(piece.range_m - piece.half_m),
                                   Eigen::Matrix<float, 1, 1>(piece.range_m + piece.half_m));
    };
    for (const HiddenPiece& piece : pieces) {
        if (!piece.far_side) others[piece.beam].extend(extent(piece));
    }
    std::erase_if(pieces, [&](const HiddenPiece& piece) {
        return piece.far_side && !others[piece.beam].intersects(extent(piece));
    });
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
