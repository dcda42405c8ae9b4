#include "calibrated/plate_image.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "calibrated/flat_plate.h"
#include "core/elementary.h"
#include "core/units.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// Cosine of 0.8 degrees: within it a sample faces as its plate does.
constexpr float faces_alike = 0.9999F;
constexpr double max_apart = 0.0142;  // the distance of two such normals
constexpr double in_plane = 1e-3;     // distance from the plane, as a share of the range

EdgeLimits edge_limits(const PointLimits& limits) {
    double sine = limits.sine;
    if (limits.elevation_sine > 0.0F)
        sine = sine > 0.0 ? std::min(sine, static_cast<double>(limits.elevation_sine))
                          : static_cast<double>(limits.elevation_sine);
    return {.depth_m = limits.depth_m, .sine = sine};
}

PlateSurface surface_of(const PlateOfPing& plate, const PlateScene& scene) {
    const Material& material = scene.materials[plate.material];
    return {.reflection = plate.strength * material.reflection,
            .roughness_m = material.roughness_m.value_or(0.0)};
}

/// Makes one echo of the parts from `first` on if the plate is a point to the beams and bins. Parts
/// of a small plate nearly cancel each other, and interpolation between beams and bins would
/// disturb this.
void join_parts(const PlateOfPing& plate, const EdgeLimits& limits, std::size_t first,
                std::vector<PlateEcho>& echoes) {
    if (echoes.size() < first + 2) return;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const PlateEdge& edge : plate.edges)
        middle += edge.from / static_cast<double>(plate.edges.size());
    const double range = arrival_range(middle.cast<float>());
    for (const PlateEdge& edge : plate.edges) {
        const double depth = arrival_range(edge.from.cast<float>()) - range;
        const bool far = limits.depth_m > 0.0 && std::fabs(depth) > 0.5 * limits.depth_m;
        const bool wide =
            limits.sine > 0.0 && (edge.from - middle).norm() > 0.5 * limits.sine * range;
        if (far || wide) return;
    }
    std::complex<double> sum = 0.0;
    for (std::size_t k = first; k < echoes.size(); ++k)
        sum += echoes[k].amplitude;
    echoes.resize(first);
    echoes.push_back({middle, range, sum});
}

/// A block of parts of echoes.
struct PlateBlock {
    PatchBlock points;
    PointEchoes echoes;
    Amplitudes amplitudes;

    /// Returns the number of parts outside the view or the range.
    std::uint64_t fill(std::span<const PlateEcho> parts, const PlateScene& scene,
                       const SonarEquation& equation) {
        points.count = static_cast<int>(parts.size());
        echoes.count =
            (points.count + PatchBlock::spare - 1) / PatchBlock::spare * PatchBlock::spare;
        std::uint64_t outside = 0;
        for (int k = 0; k < echoes.count; ++k) {
            const PlateEcho& part = parts[std::min(k, points.count - 1)];
            const Eigen::Vector3f point = part.point.cast<float>();
            points.x[k] = point.x();
            points.y[k] = point.y();
            points.z[k] = point.z();
            const auto range = static_cast<float>(part.range_m);
            const float row = (range - equation.range_min_m) / equation.bin_m - 0.5F;
            const bool is_part = k < points.count;
            const bool inside = row > -0.5F && row < static_cast<float>(equation.rows) - 0.5F &&
                                beam_of(scene.view, point) >= 0;
            outside += is_part && !inside ? 1 : 0;
            const double size = std::abs(part.amplitude);
            const double loss = static_cast<double>(equation.loss_per_m) * part.range_m;
            const bool kept = is_part && inside && size > 0.0;
            echoes.range_m[k] = range;
            echoes.row[k] = kept ? row : 0.0F;
            echoes.power[k] =
                kept ? static_cast<float>(size * size * exponential(equation.ln_headroom - loss))
                     : 0.0F;
            amplitudes.re[k] = kept ? static_cast<float>(part.amplitude.real() / size) : 0.0F;
            amplitudes.im[k] = kept ? static_cast<float>(part.amplitude.imag() / size) : 0.0F;
        }
        weigh_by_elevation(equation.elevation, points, echoes.count, echoes);
        return outside;
    }

    /// Scales the unit amplitudes to the present powers of the echoes.
    void scale() {
        for (int k = 0; k < echoes.count; ++k) {
            const float size = std::sqrt(echoes.power[k]);
            amplitudes.re[k] *= size;
            amplitudes.im[k] *= size;
        }
    }
};

}  // namespace

template <class Beams>
std::uint64_t add_plate_amplitudes(const Beams& beams, const PlateScene& scene,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   EchoGrid& grid) {
    std::vector<PlateEcho> echoes;
    const EdgeLimits edges = edge_limits(limits);
    for (const PlateOfPing& plate : scene.surface.plates) {
        const std::size_t first = echoes.size();
        add_plate_echoes(plate, surface_of(plate, scene), scene.wavelength_m, edges, echoes);
        join_parts(plate, edges, first, echoes);
    }
    PlateBlock block;
    std::uint64_t outside = 0;
    for (std::size_t first = 0; first < echoes.size(); first += PatchBlock::most) {
        const std::size_t count = std::min<std::size_t>(PatchBlock::most, echoes.size() - first);
        outside += block.fill({echoes.data() + first, count}, scene, equation);
        outside += find_columns(beams, block.points, block.echoes);
        block.scale();
        add_amplitudes(beams, block.points, block.echoes, block.amplitudes, grid);
    }
    return outside;
}

template std::uint64_t add_plate_amplitudes(const TransducerBeams&, const PlateScene&,
                                            const SonarEquation&, const PointLimits&, EchoGrid&);
template std::uint64_t add_plate_amplitudes(const ArrayBeams&, const PlateScene&,
                                            const SonarEquation&, const PointLimits&, EchoGrid&);

IncoherentShares::IncoherentShares(std::span<const FaceOfPing> faces,
                                   std::span<const Material> materials, double wavelength_m)
    : faces_(faces) {
    for (const Material& material : materials) {
        const double phase = 2.0 * 2.0 * pi / wavelength_m * material.roughness_m.value_or(0.0);
        phase2_.push_back(static_cast<float>(phase * phase));
    }
}

float IncoherentShares::phase2(std::uint32_t instance, std::uint32_t material,
                               const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
    const double slack = in_plane * arrival_range(point);
    const double x = -static_cast<double>(normal.x());
    const auto before = [&](const FaceOfPing& face) {
        return face.instance < instance ||
               (face.instance == instance && face.normal.x() < x - max_apart);
    };
    auto at = std::partition_point(faces_.begin(), faces_.end(), before);
    for (; at != faces_.end() && at->instance == instance && at->normal.x() < x + max_apart; ++at) {
        const FaceOfPing& face = *at;
        if (face.material == material &&
            std::fabs(face.normal.dot(point.cast<double>()) - face.height_m) < slack &&
            std::fabs(face.normal.cast<float>().dot(normal)) > faces_alike)
            return phase2_[material];
    }
    return incoherent;
}

}  // namespace sonarsim
