#include "input/scene/maps/ground_maps.h"

#include <cmath>
#include <utility>

#include "core/hash.h"
#include "core/text.h"

// The power that a footprint sends back is the integral of the power of its points. A map is
// constant within a texel, so the mean over a footprint is a sum over texels: the power of a texel
// times the share of the footprint that it covers. A texel smaller than a bin counts by its area.
// The mean is found with probes along the footprint's longer edge. Each probe is a box as wide as
// the footprint is across that edge; the integral of the map over the box is exact.

namespace sonarsim {

namespace {

constexpr int max_probes = 64;

// A box without width has no mean.
constexpr double min_box_texels = 1e-3;

/// Index of the texel at texel coordinates; nothing beyond the image.
std::optional<std::size_t> texel_at(const TexelFrame& frame, const Eigen::Vector2d& texels) {
    const double column = std::floor(texels.x());
    const double row = std::floor(texels.y());
    if (!(column >= 0.0 && column < frame.width && row >= 0.0 && row < frame.height))
        return std::nullopt;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.width) +
           static_cast<std::size_t>(column);
}

/// The box in texels around a point of the world that reaches `half_m` to all sides.
Eigen::AlignedBox2d box_around(const TexelFrame& frame, const Eigen::Vector2d& world,
                               const Eigen::Vector2d& half_m) {
    const Eigen::Vector2d at = frame.texels(world);
    const Eigen::Vector2d half =
        half_m.cwiseProduct(frame.per_m.cwiseAbs()).cwiseMax(0.5 * min_box_texels);
    return {at - half, at + half};
}

/// The distance that a footprint reaches from its centre along x and y.
Eigen::Vector2d reach_m(const GroundFootprint& footprint) {
    return footprint.u.cwiseAbs() + footprint.v.cwiseAbs();
}

/// True if a box lies within one texel, or wholly beyond the image.
bool is_within_texel(const TexelFrame& frame, const Eigen::AlignedBox2d& box) {
    const bool beyond = (box.max().array() <= 0.0).any() || box.min().x() >= frame.width ||
                        box.min().y() >= frame.height;
    return beyond || (box.min().array().floor() == box.max().array().floor()).all();
}

/// Boxes in a row that represent a footprint.
struct Probes {
    int count = 1;
    Eigen::Vector2d first, step;  ///< world
    double half_m = 0.0;          ///< half the width of a box
};

Probes probes_of(const GroundFootprint& footprint) {
    const bool along_u = footprint.u.squaredNorm() > footprint.v.squaredNorm();
    const Eigen::Vector2d& edge = along_u ? footprint.u : footprint.v;
    const double length_m = 2.0 * edge.norm();
    const double area_m2 =
        4.0 * std::fabs(footprint.u.x() * footprint.v.y() - footprint.u.y() * footprint.v.x());
    const double width_m = length_m > 0.0 ? area_m2 / length_m : 0.0;
    // The probes are squares side by side, with gaps in very long footprints; a point has one.
    const double squares = length_m > 0.0 ? length_m / width_m : 1.0;
    Probes out;
    out.count = static_cast<int>(std::ceil(std::clamp(squares - 1e-6, 1.0, 1.0 * max_probes)));
    out.step = 2.0 / out.count * edge;
    out.first = footprint.centre - edge + 0.5 * out.step;
    out.half_m = 0.5 * width_m;
    return out;
}

void add_share(std::uint32_t material, double area, double power, std::vector<MaterialShare>& out) {
    if (!(area > 0.0)) return;
    const auto found = std::ranges::find(out, material, &MaterialShare::material);
    MaterialShare& share = found == out.end() ? out.emplace_back() : *found;
    share.material = material;
    share.area += area;
    share.power += power;
}

std::string frame_text(const TexelFrame& frame) {
    std::string out = std::to_string(frame.width) + " " + std::to_string(frame.height);
    for (const double x :
         {frame.corner_m.x(), frame.corner_m.y(), frame.per_m.x(), frame.per_m.y()})
        out += " " + number_text(x);
    return out;
}

template <class T>
std::string bytes_hash(const std::vector<T>& values) {
    return fnv1a_128({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace

GroundMaps::GroundMaps(std::optional<MaterialTexels> materials,
                       std::optional<StrengthTexels> strengths, std::vector<char> ground)
    : materials_(std::move(materials)),
      strengths_(std::move(strengths)),
      ground_(std::move(ground)) {
    const std::size_t count = materials_ ? materials_->materials.size() : 0;
    for (std::size_t m = 0; m < count; ++m) {
        counts_.emplace_back(
            materials_->frame.width, materials_->frame.height,
            [&](std::size_t texel) { return materials_->choice[texel] == m ? 1U : 0U; });
    }
    if (!strengths_) return;
    gains_ = {strengths_->frame.width, strengths_->frame.height, [&](std::size_t texel) {
                  return static_cast<double>(strengths_->factor[texel]) - 1.0;
              }};
}

MappedPoint GroundMaps::at(std::uint32_t instance, std::uint32_t own,
                           const Eigen::Vector2d& world) const {
    MappedPoint out{own, 1.0F};
    if (has_materials(instance)) {
        const auto texel = texel_at(materials_->frame, materials_->frame.texels(world));
        if (texel && materials_->choice[*texel] != MaterialTexels::own)
            out.material = materials_->materials[materials_->choice[*texel]];
    }
    if (has_strengths(instance)) {
        const auto texel = texel_at(strengths_->frame, strengths_->frame.texels(world));
        if (texel) out.strength = strengths_->factor[*texel];
    }
    return out;
}

std::optional<std::uint32_t> GroundMaps::material_over(std::uint32_t instance, std::uint32_t own,
                                                       const GroundFootprint& footprint) const {
    if (!has_materials(instance)) return own;
    const TexelFrame& frame = materials_->frame;
    const Eigen::AlignedBox2d box = box_around(frame, footprint.centre, reach_m(footprint));
    const auto texel = texel_at(frame, frame.texels(footprint.centre));
    const bool is_own = !texel || materials_->choice[*texel] == MaterialTexels::own;
    const std::uint32_t here = is_own ? own : materials_->materials[materials_->choice[*texel]];
    if (is_within_texel(frame, box)) return here;
    const Eigen::AlignedBox2d whole(box.min().array().floor(), box.max().array().ceil());
    // If no texel of the box has a material of the map, the ground's own material fills the box.
    const bool is_alike =
        is_own ? std::ranges::all_of(counts_, [&](const auto& c) { return c.over(whole) == 0.0; })
               : counts_[materials_->choice[*texel]].over(whole) >= whole.volume();
    return is_alike ? std::optional(here) : std::nullopt;
}

std::optional<MappedPoint> GroundMaps::alike_over(std::uint32_t instance, std::uint32_t own,
                                                  const GroundFootprint& footprint,
                                                  bool with_strength) const {
    if (with_strength && has_strengths(instance)) {
        const TexelFrame& frame = strengths_->frame;
        if (!is_within_texel(frame, box_around(frame, footprint.centre, reach_m(footprint))))
            return std::nullopt;
    }
    const auto material = material_over(instance, own, footprint);
    if (!material) return std::nullopt;
    return MappedPoint{*material,
                       with_strength ? at(instance, own, footprint.centre).strength : 1.0F};
}

double GroundMaps::factor_over(const Eigen::Vector2d& world, const Eigen::Vector2d& half_m) const {
    const TexelFrame& frame = strengths_->frame;
    const Eigen::AlignedBox2d box = box_around(frame, world, half_m);
    if (is_within_texel(frame, box)) {
        const auto texel = texel_at(frame, frame.texels(world));
        return texel ? static_cast<double>(strengths_->factor[*texel]) : 1.0;
    }
    // Rounding may make a factor near 0 slightly negative.
    return std::max(0.0, 1.0 + gains_.over(box) / box.volume());
}

void GroundMaps::shares_over(std::uint32_t instance, std::uint32_t own,
                             const GroundFootprint& footprint,
                             std::vector<MaterialShare>& out) const {
    out.clear();
    const Probes probes = probes_of(footprint);
    const Eigen::Vector2d half_m = Eigen::Vector2d::Constant(probes.half_m);
    const double per_probe = 1.0 / probes.count;
    const bool varies = has_strengths(instance);
    // Most footprints have one material.
    if (const auto material = material_over(instance, own, footprint)) {
        double sum = 0.0;
        for (int k = 0; k < probes.count; ++k)
            sum += varies ? factor_over(probes.first + k * probes.step, half_m) : 1.0;
        out.push_back({*material, 1.0, sum * per_probe});
        return;
    }
    for (int k = 0; k < probes.count; ++k) {
        const Eigen::Vector2d world = probes.first + k * probes.step;
        const double factor = varies ? factor_over(world, half_m) : 1.0;
        const Eigen::AlignedBox2d box = box_around(materials_->frame, world, half_m);
        const double per_area = 1.0 / box.volume();
        double left = 1.0;
        for (std::size_t m = 0; m < counts_.size(); ++m) {
            const double share = std::min(counts_[m].over(box) * per_area, left);
            add_share(materials_->materials[m], share * per_probe, factor * share * per_probe, out);
            left -= share;
        }
        constexpr double rounding = 1e-6;
        if (left > rounding) add_share(own, left * per_probe, factor * left * per_probe, out);
    }
}

std::string GroundMaps::identity() const {
    std::string out = "\nground " + bytes_hash(ground_);
    if (materials_) {
        out += "\nmaterials " + frame_text(materials_->frame) + bytes_hash(materials_->choice) +
               bytes_hash(materials_->materials);
    }
    if (strengths_)
        out += "\nstrengths " + frame_text(strengths_->frame) + bytes_hash(strengths_->factor);
    return out;
}

}  // namespace sonarsim
