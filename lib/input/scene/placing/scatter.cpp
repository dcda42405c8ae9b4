#include "input/scene/placing/scatter.h"

#include "core/pose.h"
#include "core/random.h"
#include "core/text.h"
#include "core/units.h"

namespace sonarsim {

namespace {

bool is_free(const Hull& room, double spacing_m, const std::vector<Hull>& taken) {
    return std::ranges::none_of(taken, [&](const Hull& other) {
        const double distance = distance_between(room, other, spacing_m);
        return distance <= 0.0 || distance < spacing_m;
    });
}

std::pair<std::int64_t, std::int64_t> cell_at(const Eigen::Vector2d& point, double width_m) {
    const Eigen::Vector2d cell = (point / width_m).array().floor();
    return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y())};
}

/// Draws for an object: the second word of the counter. The first is the attempt's number.
enum class Draw : std::uint32_t { count, shape, scale, roll, pitch, yaw, bury, x, y, share };

/// The draws of one object of one rule.
using ObjectDraws = NamedDraws<Draw>;

ObjectDraws draws_of(std::uint64_t seed, std::uint32_t rule, std::uint32_t object) {
    return {stream_key(seed, rule, object, Stream::scatter)};
}

/// Index of one of `count` equally likely choices.
std::size_t one_of(std::size_t count, const ObjectDraws& draws, Draw what) {
    return std::min(static_cast<std::size_t>(draws.unit(what) * static_cast<double>(count)),
                    count - 1);
}

std::size_t count_of(const ScatterConfig& rule, std::uint64_t seed, std::uint32_t rule_index) {
    constexpr std::uint32_t rule_count_key = 0xFFFFFFFFU;
    const ObjectDraws draws = draws_of(seed, rule_index, rule_count_key);
    if (rule.density_per_m2[1] > 0.0) {
        // The fraction of the drawn mean is the probability of one more.
        const double mean = rule.area_m2() * draws.in(rule.density_per_m2, Draw::count);
        return static_cast<std::size_t>(mean + draws.unit(Draw::share));
    }
    const auto min_count = static_cast<std::size_t>(rule.count[0]);
    const auto max_count = static_cast<std::size_t>(rule.count[1]);
    return min_count + one_of(max_count - min_count + 1, draws, Draw::count);
}

constexpr int max_tries = 1000;  // positions for each object

/// The area of a rule; that of the bottom if it has none.
Eigen::AlignedBox2d area_of(const ScatterConfig& rule, const Bottom& bottom) {
    if (!rule.area_min_m) return bottom.area();
    return {Eigen::Vector2d(rule.area_min_m->data()), Eigen::Vector2d(rule.area_max_m->data())};
}

Hull shifted(Hull hull, const Eigen::Vector2d& by) {
    for (Eigen::Vector2d& corner : hull)
        corner += by;
    return hull;
}

/// An object with the ground that it covers.
struct Placed {
    ScatteredObject object;
    Hull ground;
};

/// One object whose positions are tried one after the other.
struct Attempt {
    const ScatterConfig& rule;
    Eigen::AlignedBox2d area;
    const Bottom& bottom;
    const TakenGround& taken;
    std::size_t chosen;  ///< number of the shape
    const Surface& shape;
    const Stance& stance;
    const Hull& outline;  ///< outline of the rotated shape about its origin
    // Numbers of refused positions by reason.
    int outside = 0;
    int crowded = 0;
    int no_bottom = 0;

    bool fits(const Hull& room) {
        const bool inside =
            std::ranges::all_of(room, [&](const Eigen::Vector2d& p) { return area.contains(p); });
        const bool alone = inside && (rule.overlap || taken.has_room(room, rule.spacing_m));
        outside += !inside;
        crowded += inside && !alone;
        return alone;
    }

    /// The object and its ground if there is room for it.
    std::optional<Placed> at(const Eigen::Vector2d& position) {
        // Cheap test first, with the outline before the object is lowered.
        Hull room = shifted(outline, position);
        if (!fits(room)) return std::nullopt;
        const auto T_world_shape = put_on_bottom(bottom, shape, position, stance);
        if (!T_world_shape) {
            ++no_bottom;
            return std::nullopt;
        }
        if (rule.align) {
            // The object may have been tilted on a slope, so its outline is tested again.
            room = hull_of(moved(shape, *T_world_shape).vertices);
            if (!fits(room)) return std::nullopt;
        }
        return Placed{{chosen, *T_world_shape}, std::move(room)};
    }
};

/// The `number`-th of `count` objects of a rule at the first position with room. `redraw` counts
/// the draws of scale and burial. Returns nullopt if it lies wholly below the bottom.
std::optional<Placed> place_one(const ScatterConfig& rule, std::span<const Surface* const> shapes,
                                const ObjectDraws& draws, std::uint32_t redraw,
                                const Bottom& bottom, const TakenGround& taken, std::size_t number,
                                std::size_t count) {
    const std::size_t chosen = one_of(shapes.size(), draws, Draw::shape);
    const Surface& shape = *shapes[chosen];
    const auto angle = [&](const std::array<double, 2>& deg, Draw what) {
        return draws.in({radians(deg[0]), radians(deg[1])}, what);
    };
    Stance stance{.rotation = rotation_from_rpy(angle(rule.roll_deg, Draw::roll),
                                                angle(rule.pitch_deg, Draw::pitch),
                                                angle(rule.yaw_deg, Draw::yaw)),
                  .scale = draws.in(rule.scale, Draw::scale, redraw),
                  .align = rule.align,
                  .bury_m = draws.in(rule.bury_m, Draw::bury, redraw)};
    Eigen::Affine3d upright = Eigen::Affine3d::Identity();
    upright.linear() = stance.scale * stance.rotation.toRotationMatrix();
    const Surface turned = moved(shape, upright);
    stance.bury_m += draws.in(rule.bury, Draw::share, redraw) * box_of(turned).sizes().z();
    const Hull outline = hull_of(turned.vertices);
    const Eigen::AlignedBox2d area = area_of(rule, bottom);
    Attempt attempt{rule, area, bottom, taken, chosen, shape, stance, outline};
    std::optional<Placed> found;
    for (int i = 0; i < max_tries && !found; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        const Eigen::Vector2d position(draws.in({area.min().x(), area.max().x()}, Draw::x, n),
                                       draws.in({area.min().y(), area.max().y()}, Draw::y, n));
        found = attempt.at(position);
    }
    if (!found) {
        refuse(rule.place,
               "'{}': object {} of {} finds no room in {} tries: {} reach out of the area, {} come "
               "too near to other objects, {} have no bottom below; take a larger area, fewer or "
               "smaller objects or less spacing_m",
               printable(rule.name), number + 1, count, max_tries, attempt.outside, attempt.crowded,
               attempt.no_bottom);
    }
    if (stance.bury_m > 0.0 && lies_below(bottom, moved(shape, found->object.T_world_shape)))
        return std::nullopt;
    return found;
}

}  // namespace

void TakenGround::add(Hull hull) {
    if (hull.empty()) return;
    constexpr double min_width_m = 1e-3;  // the numbers of narrower cells would be too large
    const Eigen::AlignedBox2d box = box_of(hull);
    const int exponent = std::ilogb(std::max(box.sizes().maxCoeff(), min_width_m)) + 1;
    levels_[exponent][cell_at(box.center(), std::ldexp(1.0, exponent))].push_back(std::move(hull));
}

bool TakenGround::has_room(const Hull& room, double spacing_m) const {
    const Eigen::AlignedBox2d box = box_of(room);
    for (const auto& [exponent, cells] : levels_) {
        const double width_m = std::ldexp(1.0, exponent);
        // A hull reaches half a cell beyond the middle of its box; the rest is for rounding.
        const double reach_m = spacing_m + 0.51 * width_m + 1e-3;
        const auto [west, south] = cell_at(box.min().array() - reach_m, width_m);
        const auto [east, north] = cell_at(box.max().array() + reach_m, width_m);
        for (auto column = cells.lower_bound({west, south}); column != cells.end();) {
            const auto [x, y] = column->first;
            if (x > east) break;
            if (y < south) {
                column = cells.lower_bound({x, south});
            } else if (y > north) {
                column = cells.lower_bound({x + 1, south});
            } else {
                if (!is_free(room, spacing_m, column->second)) return false;
                ++column;
            }
        }
    }
    return true;
}

std::optional<Eigen::Affine3d> put_on_bottom(const Bottom& bottom, const Surface& shape,
                                             const Eigen::Vector2d& position,
                                             const Stance& stance) {
    const auto at = [&](const Eigen::Quaterniond& rotation) {
        Eigen::Affine3d T = Eigen::Affine3d::Identity();
        T.translation() << position, 0.0;
        T.linear() = stance.scale * rotation.toRotationMatrix();
        return T;
    };
    Eigen::Affine3d T_world_shape = at(stance.rotation);
    if (stance.align) {
        const Surface level = moved(shape, T_world_shape);
        T_world_shape = at(slope_of(bottom, box_from_above(level.vertices)) * stance.rotation);
    }
    const auto lift = lift_to_rest(bottom, moved(shape, T_world_shape));
    if (!lift) return std::nullopt;
    T_world_shape.translation().z() = *lift - stance.bury_m;
    return T_world_shape;
}

std::vector<ScatteredObject> scatter(const ScatterConfig& rule,
                                     std::span<const Surface* const> shapes,
                                     std::uint32_t rule_index, std::uint64_t seed,
                                     const Bottom& bottom, TakenGround& taken) {
    constexpr std::uint32_t max_redraws = 100;
    const std::size_t count = count_of(rule, seed, rule_index);
    std::vector<ScatteredObject> objects;
    for (std::size_t i = 0; i < count; ++i) {
        const ObjectDraws draws = draws_of(seed, rule_index, static_cast<std::uint32_t>(i));
        std::optional<Placed> placed;
        for (std::uint32_t redraw = 0; redraw < max_redraws && !placed; ++redraw)
            placed = place_one(rule, shapes, draws, redraw, bottom, taken, i, count);
        if (!placed) {
            refuse(rule.place,
                   "'{}': object {} lies wholly below the bottom in all of {} draws; lower bury or "
                   "bury_m",
                   printable(rule.name), i + 1, max_redraws);
        }
        taken.add(std::move(placed->ground));
        objects.push_back(placed->object);
    }
    return objects;
}

}  // namespace sonarsim
