#include "calibrated/plate_image.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "calibrated/flat_plate.h"
#include "core/elementary.h"
#include "core/units.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// A sample belongs to a plate if it faces as the plate does, within 0.8 degrees, and lies in its
// plane, within this share of its range.
constexpr float faces_alike = 0.9999F;
constexpr double in_plane = 1e-3;

EdgeLimits edge_limits(const PointLimits& limits) {
    double sine = limits.sine;
    if (limits.elevation_sine > 0.0F)
        sine = sine > 0.0 ? std::min(sine, static_cast<double>(limits.elevation_sine))
                          : static_cast<double>(limits.elevation_sine);
    return {.depth_m = limits.depth_m, .sine = sine};
}

PlateSurface surface_of(const Material& material) {
    return {.reflection = material.reflection, .roughness_m = material.roughness_m.value_or(0.0)};
}

/// A block of parts of echoes.
struct PlateBlock {
    PatchBlock points;
    PointEchoes echoes;
    Amplitudes amplitudes;

    /// Returns how many of the parts are outside the view or the range.
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
            const bool meant = k < points.count;
            const bool inside = row > -0.5F && row < static_cast<float>(equation.rows) - 0.5F &&
                                beam_of(scene.view, point) >= 0;
            outside += meant && !inside ? 1 : 0;
            const double size = std::abs(part.amplitude);
            const double loss = static_cast<double>(equation.loss_per_m) * part.range_m;
            const bool kept = meant && inside && size > 0.0;
            echoes.range_m[k] = range;
            echoes.row[k] = kept ? row : 0.0F;
            echoes.power[k] =
                kept ? static_cast<float>(size * size * exponential(equation.raised - loss)) : 0.0F;
            amplitudes.re[k] = kept ? static_cast<float>(part.amplitude.real() / size) : 0.0F;
            amplitudes.im[k] = kept ? static_cast<float>(part.amplitude.imag() / size) : 0.0F;
        }
        weigh_by_elevation(equation.elevation, points, echoes.count, echoes);
        return outside;
    }

    /// Gives the unit amplitudes the sizes that the echoes have by now.
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
    for (const PlateOfPing& plate : scene.plates) {
        add_plate_echoes(plate, surface_of(scene.materials[plate.material]), scene.wavelength_m,
                         edge_limits(limits), echoes);
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

std::vector<Sample> incoherent_samples(std::span<const Sample> samples, const PlateScene& scene) {
    std::vector<Sample> out(samples.begin(), samples.end());
    std::unordered_map<std::uint32_t, std::vector<const PlateOfPing*>> by_instance;
    for (const PlateOfPing& plate : scene.plates)
        by_instance[plate.instance].push_back(&plate);
    const double phase_per_m = 2.0 * 2.0 * pi / scene.wavelength_m;
    for (Sample& sample : out) {
        const Material& material = scene.materials[sample.material];
        const auto plates = by_instance.find(sample.instance);
        if (!material.roughness_m || plates == by_instance.end()) continue;
        const Eigen::Vector3d position = sample.position.cast<double>();
        const double range = arrival_range(sample.position);
        const auto has_it = [&](const PlateOfPing* plate) {
            return plate->material == sample.material &&
                   std::fabs(plate->normal.dot(position) - plate->height_m) < in_plane * range &&
                   std::fabs(plate->normal.cast<float>().dot(sample.normal)) > faces_alike;
        };
        const bool on_plate = std::ranges::any_of(plates->second, has_it);
        if (!on_plate) continue;
        const double phase = phase_per_m * *material.roughness_m * sample.height_m / range;
        sample.area_m2 *= static_cast<float>(1.0 - exponential(-phase * phase));
    }
    return out;
}

}  // namespace sonarsim
