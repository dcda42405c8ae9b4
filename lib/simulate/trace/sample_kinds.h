#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The source of the phase of an echo, in an echo model that has phases.
enum class PhaseSource {
    scene,  ///< the scatterers of the scene
    own,    ///< each sample has one of its own, the same in all pings
    ping    ///< it is drawn for each ping
};

/// The properties of the samples of a kind.
struct KindOfSample {
    SampleKind kind = SampleKind::surface;
    PhaseSource phase = PhaseSource::scene;
    const char* stream = "";  ///< names the draws of the phases, if they have draws of their own
    bool is_surface = false;  ///< the scene and the reference have it; else it belongs to the water
    bool is_point = false;    ///< its area is its backscattering cross-section
    bool hides = false;       ///< it ends the water and the sight lines of labels
    bool has_labels = false;
};

/// All kinds, in the order in which their echoes are added.
inline constexpr std::array<KindOfSample, 5> kinds_of_samples{{
    {SampleKind::surface, PhaseSource::scene, "", true, false, true, true},
    {SampleKind::target, PhaseSource::own, "", true, false, true, true},
    {SampleKind::particle, PhaseSource::own, "particles", false, true, false, true},
    {SampleKind::behind_wall, PhaseSource::ping, "behind walls", true, false, false, true},
    {SampleKind::water_surface, PhaseSource::ping, "water surface", false, false, false, false},
}};

constexpr const KindOfSample& kind_of(SampleKind kind) {
    return kinds_of_samples[static_cast<std::size_t>(kind)];
}

/// The samples of a ping by kind.
class SamplesByKind {
  public:
    /// `joined`: targets count as surface. `samples` must outlive this object.
    SamplesByKind(const std::vector<Sample>& samples, bool joined) {
        const auto hides = [](const Sample& sample) { return kind_of(sample.kind).hides; };
        const auto is_target = [](const Sample& sample) {
            return sample.kind == SampleKind::target;
        };
        const auto end = std::find_if(samples.rbegin(), samples.rend(), hides).base();
        const std::span<const Sample> visible{samples.begin(), end};
        kinds_[0] = visible;
        if (!joined && std::ranges::any_of(visible, is_target)) {
            surface_.reserve(visible.size());
            std::ranges::partition_copy(visible, std::back_inserter(targets_),
                                        std::back_inserter(surface_), is_target);
            kinds_[0] = surface_;
            kinds_[1] = targets_;
        }
        for (auto first = end; first != samples.end();) {
            const SampleKind kind = first->kind;
            const auto next = std::find_if(
                first, samples.end(), [&](const Sample& sample) { return sample.kind != kind; });
            kinds_[static_cast<std::size_t>(kind)] = {first, next};
            first = next;
        }
    }
    SamplesByKind(const SamplesByKind&) = delete;

    std::span<const Sample> of(SampleKind kind) const {
        return kinds_[static_cast<std::size_t>(kind)];
    }

  private:
    std::array<std::span<const Sample>, kinds_of_samples.size()> kinds_{};
    std::vector<Sample> surface_, targets_;  ///< copies, if they are mixed
};

}  // namespace sonarsim
