#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "trace/ping.h"
#include "trace/terms.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// The inputs of an image besides the traced ping.
struct FormContext {
    const View& view;
    const Scene& scene;
    PingDraws draws;
    Terms terms;
};

/// An echo model: PaperModel (paper/paper_model.h) or CalibratedModel (calibrated/model.h). It
/// turns what a sonar saw into an image. Models are immutable; any number of threads may form
/// images at once.
class EchoModel {
  public:
    virtual ~EchoModel() = default;

    /// Fills the image [range bins, beams] of `ping`, which is 0, its counts and its seconds. A
    /// pure function: the same arguments give the same bytes.
    virtual void form(const TracedPing& traced, const FormContext& context, Ping& ping) const = 0;
    /// The names of its random terms, in the order in which they enter an image.
    virtual std::span<const std::string_view> random_terms() const = 0;

    /// The guard beams that it needs.
    virtual GuardBeams guard_beams() const { return {}; }
    /// True if paths are needed that the second surface mirrors away from the sonar: a rough
    /// surface scatters sound back along them.
    virtual bool needs_scattered_paths() const { return false; }
    /// The error goal at which this view has to be seen by rays; 0: any engine will do.
    virtual double rays_goal(const View& /*view*/) const { return 0.0; }
    /// True if a bin is the sum of its echoes' energies, and not their mean.
    virtual bool energies_add() const { return false; }
    /// True if an image takes so long that previews and checks of a mission form fewer of them.
    virtual bool is_slow() const { return false; }
    /// The memory that it needs while it forms an image, besides the image, bytes.
    virtual double working_bytes(bool /*multipath*/) const { return 0.0; }

    /// The mean signal of a pixel and the deviation of its noise. `clean` is the pixel without the
    /// random terms of pixels, `noisy` the pixel with them.
    struct SignalAndNoise {
        double signal, noise;
    };
    virtual SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                            int beam) const = 0;

    /// Adds what the numbers of an image mean to the sensor's block in dataset.json.
    virtual void describe(nlohmann::ordered_json& /*sensor*/) const {}
    /// The bits of the numbers in raw/ and raw.npy; 0: the model has none.
    virtual int raw_bits() const { return 0; }
    /// The numbers that the instrument delivers, [range bins, beams].
    virtual std::vector<std::uint16_t> raw(const Ping& /*ping*/) const { return {}; }
};

}  // namespace sonarsim
