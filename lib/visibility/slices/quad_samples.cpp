#include "visibility/slices/quad_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "visibility/slices/fit_range.h"

namespace sonarsim {

namespace {

// Largest number of parts across a patch.
constexpr float most_parts = 8.0F;

// Towards the line in which all slices meet, a patch is divided into narrower ones down to this
// share of its width. The rest has a four-hundredth of the area.
constexpr float least_width_share = 0.05F;

// A parallelogram is as wide at its far end as at its near end; the surface is not. So a patch may
// extend from one range to at most this many times that range.
constexpr float longest_ratio = 1.5F;

// Surface at a smaller cosine to the line of sight is grazing: so dark that it dims a bin of other
// surface by its area alone. Chosen.
constexpr float grazing_cosine = 0.1F;

// Rounding margin for the area of a quadrilateral that is narrow in the picture.
constexpr float area_rounding = 1.01F;

/// The area of a quadrilateral on a plane if it lies as far as `X3`, the cube of its X, m^2. On a
/// plane dA = X^3 du dw / h.
float area_at(const QuadPoints& p, float X3, float height_m) {
    const float picture =
        std::fabs((p.u[2] - p.u[0]) * (p.w[3] - p.w[1]) - (p.u[3] - p.u[1]) * (p.w[2] - p.w[0]));
    return 0.5F * picture * X3 / height_m;
}

/// The area of a quadrilateral, m^2. QuadPoints lie within the range of their surface. Where the
/// plane reaches beyond it, this moves corners off the plane. They then span less area than is
/// seen, or, if the surface is nearly edge-on and two u are nearly equal, an area along the line of
/// sight that does not exist: up to hundreds of times that of the triangle. So the area of moved
/// corners is that of their picture.
float area_of(const QuadPoints& p, const Interval& range_m, float height_m) {
    const bool moved = (p.range <= range_m.from || p.range >= range_m.to).any();
    if (moved) return area_at(p, p.X.cube().mean(), height_m);
    const float X = p.X.maxCoeff();
    const float area = 0.5F * (p.at(2) - p.at(0)).cross(p.at(3) - p.at(1)).norm();
    return std::min(area, area_rounding * area_at(p, X * X * X, height_m));
}

RangeLine range_line(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    RangeLine line;
    line.from = from;
    line.length = (to - from).norm();
    line.along = line.length > 0.0F ? Eigen::Vector3f((to - from) / line.length) : from;
    line.s0 = from.dot(line.along);
    line.s1 = line.s0 + line.length;
    line.h2 = std::max(from.squaredNorm() - line.s0 * line.s0, 0.0F);
    const float nearest = line.s0 > 0.0F ? line.s0 : line.s1 < 0.0F ? -line.s1 : 0.0F;
    line.near2 = line.h2 + nearest * nearest;
    line.far2 = line.h2 + std::max(line.s0 * line.s0, line.s1 * line.s1);
    return line;
}

}  // namespace

QuadSampler::QuadSampler(const FrameScan& scan, std::span<const Material> materials,
                         const PatchLimits& limits, BeamSums& sums, std::vector<Sample>& out)
    : scan_(scan),
      materials_(materials),
      sums_(sums),
      limits_(limits),
      any_width_(!scan.frame().meridians || limits.widest_ratio == unbounded),
      out_(out),
      R_sensor_frame_(scan.frame().R_frame_sensor.transpose()) {}

/// Divides a quadrilateral along w into patches that are nearly parallelograms.
void QuadSampler::add(const Quad& quad) {
    const QuadPoints corners = quad.corners(quad.low, quad.high, 0.0F, 1.0F);
    if (is_small(corners)) {
        if (any_width_) {
            add_patch(quad, corners, 0.0F, 1.0F);
        } else {
            add_narrow(quad, 0.0F, 1.0F);
        }
        return;
    }
    const float u = 0.5F * (quad.low.u + quad.high.u);
    const float w_low = quad.middle_low();
    const float w_high = quad.middle_high();
    const QuadPoints ends = quad.points({u, u, u, u}, {w_low, w_high, w_low, w_high});
    const RangeLine line = range_line(ends.at(0), ends.at(1));
    const float reach2 = limits_.range_max_m * limits_.range_max_m;
    if (line.near2 > reach2) return;
    const auto sag = [&](float step, float range2) {
        return step * step * line.h2 <= 8.0F * limits_.sag_m * range2 * std::sqrt(range2);
    };
    if (line.length <= limits_.shortest_m ||
        (sag(line.length, line.near2) && line.far2 <= longest_ratio * longest_ratio * line.near2 &&
         line.far2 <= reach2)) {
        add_narrow(quad, 0.0F, 1.0F);
        return;
    }
    cut(line);
    // Converts positions along the line to shares of the way between the borders.
    const float per_w = 1.0F / (w_high - w_low);
    const auto share = [&](float s) {
        const Eigen::Vector3f p = line.from + (s - line.s0) * line.along;
        return std::clamp((p.z() / p.x() - w_low) * per_w, 0.0F, 1.0F);
    };
    float last = share(cuts_.front());
    for (std::size_t i = 1; i < cuts_.size(); ++i) {
        const float next = share(cuts_[i]);
        if (next > last) add_narrow(quad, last, next);
        last = next;
    }
}

/// Fills `cuts_` with positions along the line, so that the range bends little between two of them:
/// steps outward from the nearest point, then in order.
void QuadSampler::cut(const RangeLine& line) {
    const float reach2 = limits_.range_max_m * limits_.range_max_m;
    const float reach = std::sqrt(std::max(reach2 - line.h2, 0.0F)) + limits_.shortest_m;
    const auto outward = [&](float begin, float end) {
        end = std::min(end, reach);
        for (float s = begin; s < end;) {
            const float range2 = line.h2 + s * s;
            const float range = std::sqrt(range2);
            const float bend = std::sqrt(8.0F * limits_.sag_m * range2 * range / line.h2);
            const float step =
                std::max(std::min(bend, (longest_ratio - 1.0F) * range), limits_.shortest_m);
            s = s + 1.25F * step < end ? s + step : end;
            cuts_.push_back(s);
        }
    };
    cuts_.clear();
    if (line.s0 < 0.0F) {
        outward(std::max(-line.s1, 0.0F), -line.s0);
        std::ranges::reverse(cuts_);
        for (float& s : cuts_)
            s = -s;
    }
    cuts_.push_back(std::clamp(0.0F, line.s0, line.s1));
    if (line.s1 > 0.0F) outward(std::max(line.s0, 0.0F), line.s1);
}

/// A cheap bound: true if the sag along w is below the limit of add(). The foot of the
/// perpendicular is not farther than the nearest point, h <= r, which is at least 0.9 of the
/// nearest corner.
bool QuadSampler::is_small(const QuadPoints& corners) const {
    const float nearest = corners.range.minCoeff();
    const float length2 = (corners.middle(2, 3) - corners.middle(0, 1)).squaredNorm();
    return corners.range.maxCoeff() <= limits_.range_max_m &&
           length2 <= std::min(7.0F * limits_.sag_m * nearest, 0.01F * nearest * nearest);
}

/// Adds the part of a quadrilateral between two shares of the way along w, in patches with similar
/// widths at both ends.
void QuadSampler::add_narrow(const Quad& quad, float from, float to) {
    if (any_width_) {
        add_patch(quad, from, to);
        return;
    }
    // Between two meridians the width is proportional to X, and 1 / X is linear in w.
    const float u = 0.5F * (quad.low.u + quad.high.u);
    const auto X_at = [&](float share) {
        const float w = quad.middle_low() + share * (quad.middle_high() - quad.middle_low());
        return quad.points({u, u, u, u}, {w, w, w, w}).X[0];
    };
    const float X_from = X_at(from);
    const float X_to = X_at(to);
    const bool narrows = X_to < X_from;
    const float widest = std::max(X_from, X_to);
    const float narrowest = std::max(std::min(X_from, X_to), least_width_share * widest);
    const float per_share = (1.0F / X_to - 1.0F / X_from) / (to - from);
    float last = narrows ? from : to;
    if (widest == unbounded) return;
    float X = widest / limits_.widest_ratio;
    while (X > narrowest) {
        const float next = std::clamp(from + (1.0F / X - 1.0F / X_from) / per_share, from, to);
        if (next != last) add_patch(quad, std::min(last, next), std::max(last, next));
        last = next;
        X /= limits_.widest_ratio;
    }
    const float end = narrows ? to : from;
    if (end != last) add_patch(quad, std::min(last, end), std::max(last, end));
}

/// Adds the part of a quadrilateral between two shares of the way along w. It is divided across if
/// its ranges are not those of a parallelogram.
void QuadSampler::add_patch(const Quad& quad, float from, float to) {
    add_patch(quad, quad.corners(quad.low, quad.high, from, to), from, to);
}

void QuadSampler::add_patch(const Quad& quad, const QuadPoints& corners, float from, float to) {
    const Eigen::Array4f& r = corners.range;
    const float across = 0.5F * std::fabs(r[1] + r[2] - r[0] - r[3]);
    const float along = 0.5F * std::fabs(r[2] + r[3] - r[0] - r[1]);
    const float farthest = r.maxCoeff();
    const float length = farthest - r.minCoeff();
    float excess = (across + along - length) / limits_.excess_m;
    const float height_m = scan_.scene().facets[quad.facet_index].height_m;
    if (height_m < grazing_cosine * farthest && length > limits_.long_grazing_m) {
        const float wedge = std::fabs(std::fabs(r[3] - r[0]) - std::fabs(r[2] - r[1]));
        excess = std::max(excess, wedge / limits_.grazing_wedge_m);
    }
    if (excess <= 1.0F) {
        add_sample(quad, corners);
        return;
    }
    const int parts = static_cast<int>(std::min(std::ceil(excess), most_parts));
    QuadSide last = quad.low;
    for (int i = 1; i <= parts; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(parts);
        const auto between = [&](float x, float y) { return x + share * (y - x); };
        const QuadSide side{between(quad.low.u, quad.high.u), between(quad.low.low, quad.high.low),
                            between(quad.low.high, quad.high.high)};
        add_sample(quad, quad.corners(last, side, from, to));
        last = side;
    }
}

void QuadSampler::add_sample(const Quad& quad, const QuadPoints& corners) {
    const FrontFacet& seen = scan_.scene().facets[quad.facet_index];
    const SliceFacet& facet = scan_.mesh().facets[seen.facet];
    const Eigen::Vector3f a = corners.at(0);
    const Eigen::Vector3f b = corners.at(1);
    const Eigen::Vector3f c = corners.at(2);
    const Eigen::Vector3f d = corners.at(3);
    const float area = area_of(corners, quad.range_m, seen.height_m);
    if (!(area > 0.0F)) return;
    Sample& sample = out_.emplace_back();
    Eigen::Vector3f middle = 0.25F * (a + b + c + d);
    if (!any_width_) {
        // The centroid of a trapezoid lies towards its wide end.
        const float one = (b - a).cross(c - a).norm();
        const float other = (c - a).cross(d - a).norm();
        // Both vanish if the patch is as narrow as rounding.
        if (one + other > 0.0F)
            middle = (one * (a + b + c) + other * (a + c + d)) / (3.0F * (one + other));
    }
    sample.position = R_sensor_frame_ * middle;
    sample.edge_u = R_sensor_frame_ * (0.25F * (b + c - a - d));
    sample.edge_v = R_sensor_frame_ * (0.25F * (c + d - a - b));
    const Interval range_m = fit_range(corners.range, sample);
    sums_.add(range_m, area, seen.height_m, materials_[facet.material].reflection);
    sample.normal = R_sensor_frame_ * seen.normal;
    sample.height_m = seen.height_m;
    sample.area_m2 = area;
    sample.material = facet.material;
    sample.instance = facet.instance;
}

}  // namespace sonarsim
