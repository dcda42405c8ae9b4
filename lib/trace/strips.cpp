#include "trace/strips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr float most_convergence = 0.966F;  // cosine of 15 degrees: the sides of a cone converge
constexpr double least_turn = 1e-3;         // rad, of a strip
constexpr int least_strip_parts = 8;
constexpr int most_strip_parts = 64;
constexpr double part_by_range = 0.1;

/// One long side of a face.
struct LongSide {
    float low = 0.0F, high = 0.0F;  ///< along the axis, of points
    Eigen::Vector3f from, to;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< the sum of its parts' normals
    bool empty = true;

    void add(const Eigen::Vector3f& point, float along) {
        if (empty || along < low) {
            low = along;
            from = point;
        }
        if (empty || along > high) {
            high = along;
            to = point;
        }
        empty = false;
    }
};

/// The border of a face on a side where the surface ends: the points that are furthest across.
LongSide free_side(const MeshFace& face, const Eigen::Vector3f& axis,
                   const Eigen::Vector3f& outwards) {
    float most = face.border.front()[0].dot(outwards);
    float least = most;
    for (const auto& side : face.border) {
        most = std::max(most, side[0].dot(outwards));
        least = std::min(least, side[0].dot(outwards));
    }
    LongSide out;
    for (const auto& side : face.border) {
        for (const Eigen::Vector3f& end : side) {
            if (end.dot(outwards) > most - 0.2F * (most - least)) out.add(end, end.dot(axis));
        }
    }
    return out;
}

/// The ruling of a strip at a share of the way from the first one to the second.
struct Across {
    Eigen::Vector3d ends[2];   ///< on the facet
    Eigen::Vector3d normal;    ///< unit
    Eigen::Vector3d sideways;  ///< unit
    double sonar_off_plane_m;  ///< the sonar's distance from the plane of normal and ruling
};

Across across_at(const PlacedStrip& strip, double share) {
    Across out;
    for (int end = 0; end < 2; ++end)
        out.ends[end] = strip.first[end] + share * (strip.second[end] - strip.first[end]);
    out.normal =
        (strip.first_normal + share * (strip.second_normal - strip.first_normal)).normalized();
    out.sideways = out.normal.cross(out.ends[1] - out.ends[0]).normalized();
    out.sonar_off_plane_m = -out.sideways.dot(0.5 * (out.ends[0] + out.ends[1]));
    return out;
}

}  // namespace

std::optional<SceneStrip> strip_of(const MeshFace& face) {
    if (face.smooth.empty()) return std::nullopt;
    const auto length = [](const SmoothSide& side) { return (side.to - side.from).norm(); };
    const SmoothSide& longest = *std::ranges::max_element(face.smooth, {}, length);
    const Eigen::Vector3f axis = (longest.to - longest.from).normalized();
    const Eigen::Vector3f across = face.normal.cross(axis);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const auto& side : face.border)
        middle += side[0] / static_cast<float>(face.border.size());
    std::array<LongSide, 2> sides;
    for (const SmoothSide& side : face.smooth) {
        const Eigen::Vector3f along = side.to - side.from;
        if (std::fabs(along.dot(axis)) < most_convergence * along.norm()) return std::nullopt;
        LongSide& of = sides[(side.from + side.to - 2.0F * middle).dot(across) > 0.0F ? 1 : 0];
        of.add(side.from, side.from.dot(axis));
        of.add(side.to, side.to.dot(axis));
        of.normal += along.norm() * side.normal;
    }
    for (int k = 0; k < 2; ++k) {
        if (!sides[k].empty) continue;
        sides[k] = free_side(face, axis, k == 0 ? Eigen::Vector3f(-across) : across);
        // Assume that the surface turns on this side as it does on the other.
        const Eigen::Vector3f there = sides[1 - k].normal;
        sides[k].normal = 2.0F * face.normal.dot(there) * face.normal - there;
    }
    const auto ruling = [](const LongSide& side) {
        return Ruling{side.from, side.to, side.normal.normalized()};
    };
    return SceneStrip{.first = ruling(sides[0]),
                      .second = ruling(sides[1]),
                      .normal = face.normal,
                      .material = face.material,
                      .instance = 0};
}

SpecularParts specular_parts(const PlacedStrip& strip) {
    SpecularParts out;
    double low = 0.0;
    double high = 1.0;
    double at_low = across_at(strip, low).sonar_off_plane_m;
    double at_high = across_at(strip, high).sonar_off_plane_m;
    if ((at_low > 0.0) == (at_high > 0.0)) return out;
    double share = 0.5;
    for (int step = 0; step < 6; ++step) {
        share = low + (high - low) * at_low / (at_low - at_high);
        const double at_share = across_at(strip, share).sonar_off_plane_m;
        const bool lower = (at_share > 0.0) == (at_low > 0.0);
        (lower ? low : high) = share;
        (lower ? at_low : at_high) = at_share;
    }
    const Across at = across_at(strip, share);
    const Eigen::Vector3d turn = strip.second_normal - strip.first_normal;
    const auto width = [&](int end) {
        return at.sideways.dot(strip.second[end] - strip.first[end]);
    };
    const double turned = at.sideways.dot(turn);
    if (std::fabs(turned) < least_turn) return out;
    const double length = (at.ends[1] - at.ends[0]).norm();
    const double range = arrival_range((0.5 * (at.ends[0] + at.ends[1])).eval().cast<float>());
    const int parts = static_cast<int>(std::clamp(std::ceil(length / (part_by_range * range)),
                                                  1.0 * least_strip_parts, 1.0 * most_strip_parts));
    // The arc of a strip of width w, which turns by t, stands off its chord by w t / 8 in the
    // middle.
    const auto on_arc = [&](double along) -> Eigen::Vector3d {
        const double off =
            0.5 * (width(0) + along * (width(1) - width(0))) * turned * share * (1.0 - share);
        return at.ends[0] + along * (at.ends[1] - at.ends[0]) + off * at.normal;
    };
    for (int k = 0; k < parts; ++k) {
        const double from = static_cast<double>(k) / parts;
        const double to = (k + 1.0) / parts;
        const double middle = 0.5 * (from + to);
        out.parts.push_back({.from = on_arc(from),
                             .to = on_arc(to),
                             .radius_m = (width(0) + middle * (width(1) - width(0))) / turned,
                             .material = 0});
        out.on_facet.push_back(at.ends[0] + middle * (at.ends[1] - at.ends[0]));
    }
    return out;
}

}  // namespace sonarsim
