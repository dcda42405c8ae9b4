#include <Eigen/Geometry>
#include <algorithm>

#include "simulate/visibility/rays/ray_columns.h"

namespace sonarsim {

namespace {

// The plane of a ray whose segment is shorter than this share of a step is poor across the column.
constexpr float short_segment = 0.1F;

/// The border between the segments of two neighbouring rays, and the ranges of both planes there.
struct Border {
    Eigen::Vector3f direction;
    float along;
    float below_m;
    float above_m;
    bool continuous;
};

/// The two sides of a column, as angles across.
struct ColumnSides {
    SinCosFloat low;
    SinCosFloat high;
};

/// The part of a column that a ray represents.
struct Segment {
    Border from;
    Border to;
    bool may_end_across;  ///< the surface may end within the column's width
};

struct Context {
    ViewShape shape;
    const Sampling& sampling;
    const RayColumns& columns;
};

/// The range at which `direction` meets the plane of `ray`, limited to `max_m` from `about_m`: at
/// grazing incidence a plane extends far beyond the edge of its surface.
float range_on_plane(const CastRay& ray, const Eigen::Vector3f& direction, float about_m,
                     float max_m) {
    const float cosine = -ray.normal.dot(direction);
    const float farthest = about_m + max_m;
    return cosine * farthest > ray.height_m ? std::max(ray.height_m / cosine, about_m - max_m)
                                            : farthest;
}

/// The border between two neighbours; at a column's ends one of them is CastRay::none.
Border border(const Context& context, const RayColumn& column, int below, int above) {
    const CastRay* const a = below == CastRay::none ? nullptr : &context.columns.rays[below];
    const CastRay* const b = above == CastRay::none ? nullptr : &context.columns.rays[above];
    Border out{};
    out.along = !a   ? column.along_min
                : !b ? column.along_max
                     : a->along + a->border * (b->along - a->along);
    out.direction = direction(context.shape, column.across, sincos_small(out.along));
    // At the end of the view the surface most likely continues; at that of an edge strip it ends.
    out.continuous = a && b ? a->continuous : column.whole;
    const bool both_met = a && b && !a->missed() && !b->missed();
    const auto range_of = [&](const CastRay* ray) {
        if (!ray || ray->missed()) return 0.0F;
        const float range = ray->range_m;
        float max_change = context.sampling.tolerance_m;
        if (out.continuous) max_change = both_met ? a->range_m + b->range_m : range;
        return range_on_plane(*ray, out.direction, range, max_change);
    };
    out.below_m = range_of(a);
    out.above_m = range_of(b);
    return out;
}

/// The surface in a ray's segment, as a parallelogram.
Sample piece(const Context& context, const CastRay& ray, const ColumnSides& sides,
             const Segment& segment) {
    const SinCosFloat middle = sincos_small(0.5F * (segment.from.along + segment.to.along));
    const float about = 0.5F * (segment.from.above_m + segment.to.below_m);
    const float max_change = segment.may_end_across ? context.sampling.tolerance_m : about;
    const Eigen::Vector3f low = direction(context.shape, sides.low, middle);
    const Eigen::Vector3f high = direction(context.shape, sides.high, middle);
    const auto onto_surface = [&](const Eigen::Vector3f& beside) -> Eigen::Vector3f {
        return beside * range_on_plane(ray, beside, about, max_change);
    };
    // A point whose range was limited lies off the plane, and multipath starts there.
    const auto onto_plane = [&](const Eigen::Vector3f& p) -> Eigen::Vector3f {
        return p - (ray.normal.dot(p) + ray.height_m) * ray.normal;
    };
    const Eigen::Vector3f from = onto_plane(segment.from.direction * segment.from.above_m);
    const Eigen::Vector3f to = onto_plane(segment.to.direction * segment.to.below_m);
    Sample sample;
    sample.position = 0.5F * (from + to);
    sample.edge_u = 0.5F * (onto_surface(high) - onto_surface(low));
    sample.edge_v = 0.5F * (to - from);
    sample.normal = ray.normal;
    sample.height_m = ray.height_m;
    // The area of surface with cosine h / r at range r in this solid angle. The parallelogram
    // itself is smaller if its ranges were limited, and because it has the width at its middle
    // angle; this area preserves the energy.
    const float solid_angle =
        (high - low).cross(segment.to.direction - segment.from.direction).norm();
    const float range = sample.position.norm();
    sample.area_m2 = solid_angle * range * range * range / ray.height_m;
    sample.material = ray.material;
    sample.instance = ray.instance;
    sample.widens_from_axis = context.shape == ViewShape::cone;
    if (!context.columns.tubes.empty()) {  // the surface is not that apparent plane
        const RayTube& tube = context.columns.tubes[&ray - context.columns.rays.data()];
        sample.normal = tube.normal;
        sample.height_m = tube.cosine * range;
        sample.area_m2 *= tube.area;
        sample.strength = tube.strength;
    }
    return sample;
}

// A parallelogram is as wide at its far end as at its near end; the surface is not. So a patch may
// extend from one range to at most this many times that range.
constexpr float longest_ratio = 2.0F;

/// The range at which a patch that begins at `from_m` ends: `to_m`, or nearer if that is too far.
float end_of_patch(float from_m, float to_m, const Sampling& sampling) {
    if (to_m > from_m) return std::min({to_m, longest_ratio * from_m, from_m + sampling.longest_m});
    return std::max({to_m, from_m / longest_ratio, from_m - sampling.longest_m});
}

/// Cuts a segment that is too long. Adds all patches but the last, which stays in `segment`.
void cut_off(const Context& context, const RayColumn& column, const CastRay& ray,
             const ColumnSides& sides, Segment& segment, std::vector<Sample>& items) {
    const Border end = segment.to;
    const float to_m = end.below_m;
    while (true) {
        const float from_m = segment.from.above_m;
        const float next_m = end_of_patch(from_m, to_m, context.sampling);
        if (!(std::fabs(next_m - from_m) < std::fabs(to_m - from_m)) || next_m == from_m) break;
        // On a plane the cosine, and so the inverse range, is linear in a small angle.
        const float share = (1.0F / from_m - 1.0F / next_m) / (1.0F / from_m - 1.0F / to_m);
        segment.to.along = segment.from.along + share * (end.along - segment.from.along);
        segment.to.direction =
            direction(context.shape, column.across, sincos_small(segment.to.along));
        segment.to.below_m = segment.to.above_m = next_m;
        items.push_back(piece(context, ray, sides, segment));
        segment.from = segment.to;
    }
    segment.to = end;
}

/// Adds the samples of a column. `narrowed`: rays that keep its middle strip; null: edge strip.
void collect(const Context& context, const RayColumn& column, const std::uint8_t* narrowed,
             std::vector<Sample>& items) {
    const int n = context.sampling.rays;
    const float first = column.along_min + context.sampling.inset * column.step;
    const auto sides_at = [&](float half_width) -> ColumnSides {
        const SinCosFloat side = sincos_small(half_width);
        return {column.across - side, column.across + side};
    };
    const ColumnSides full = sides_at(column.half_width);
    const ColumnSides middle = sides_at(column.half_width * (1.0F - 2.0F * edge_strip_share));
    Segment segment{};
    segment.from = border(context, column, CastRay::none, column.first);
    for (int i = column.first; i != CastRay::none; i = context.columns.rays[i].next) {
        const CastRay& ray = context.columns.rays[i];
        segment.to = border(context, column, i, ray.next);
        if (!ray.missed()) {
            const int at = static_cast<int>((ray.along - first) / column.step + 0.5F);
            const bool strip = !column.whole || narrowed[std::clamp(at, 0, n - 1)];
            const ColumnSides& sides = column.whole && strip ? middle : full;
            segment.may_end_across =
                strip || !segment.from.continuous || !segment.to.continuous ||
                segment.to.along - segment.from.along < short_segment * column.step;
            cut_off(context, column, ray, sides, segment, items);
            items.push_back(piece(context, ray, sides, segment));
        }
        segment.from = segment.to;
    }
}

}  // namespace

void add_column_samples(const View& view, const Sampling& sampling, const RayColumns& columns,
                        BeamRange beams, Samples& samples) {
    const Context context{view.shape, sampling, columns};
    samples.dropped += columns.dropped;
    if (samples.items.empty()) samples.items.reserve(columns.rays.size());
    samples.beam_begin.resize(view.beams + 1);
    std::size_t column = 0;
    std::size_t strip = columns.whole_columns;
    for (int j = beams.begin; j < beams.end; ++j) {
        for (; column < columns.whole_columns && columns.columns[column].beam == j; ++column) {
            collect(context, columns.columns[column],
                    columns.narrowed.data() + column * sampling.rays, samples.items);
        }
        for (; strip < columns.columns.size() && columns.columns[strip].beam == j; ++strip) {
            collect(context, columns.columns[strip], nullptr, samples.items);
        }
        samples.beam_begin[j + 1] = static_cast<std::uint32_t>(samples.items.size());
    }
}

}  // namespace sonarsim
