#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "input/scene/scene.h"
#include "simulate/trace/ping.h"
#include "simulate/trace/surface_echoes.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// The inputs of an image besides the traced ping.
struct FormContext {
    const View& view;
    const Scene& scene;
    PingDraws draws;
    Terms terms;
};

/// The width of the echo of a point in bins, by the pulse and the beam.
struct ResolutionCell {
    double range_bins = 1.0, beams = 1.0;
};

/// The properties of an echo model that are the same for all of its images.
struct EchoModelInfo {
    /// The names of the random terms, in the order in which they enter an image.
    std::span<const std::string_view> random_terms = {};
    GuardBeams guard_beams = {};  ///< the guard beams that the model needs
    /// True if the model needs the multipath paths whose second surface reflects the sound away
    /// from the sonar. A rough surface scatters sound back along them.
    bool needs_scattered_paths = false;
    bool energies_add = false;  ///< a bin is the sum of the energies of its echoes, not a mean
    /// MapStrengths::at_points: the model applies the strengths of maps itself.
    MapStrengths map_strengths = MapStrengths::in_samples;
    /// True if an image takes so long that previews and checks of a mission form fewer of them.
    bool is_slow = false;
    /// The memory to form an image, without the image itself, and that which multipath adds.
    double working_bytes = 0.0, multipath_bytes = 0.0;
    /// The factor by which the noise grows with range, by range bin; empty: it does not grow.
    std::vector<float> noise_growth = {};
    /// The mean of the receiver's noise, by range bin; empty: none, or noise_growth tells it.
    std::vector<float> mean_noise = {};
    ResolutionCell cell = {};
    /// The factor from the direct echoes of surface_echoes() within a cell to their value in the
    /// image, by range bin; empty: the image has no such unit.
    std::vector<float> echo_gain = {};
    /// The factor by which the receiver weakens echoes in each beam, and not its noise; empty: 1.
    std::vector<float> beam_gain = {};
    /// The value that is white if `output.full_scale` is auto; 0: it follows from pings.
    double white = 0.0;
    /// The transmissions of add_behind_walls(), if the model is prepared for a scene.
    std::vector<float> wall_transmissions = {};
    int raw_bits = 0;  ///< number of bits of a value in raw/ and raw.npy; 0: no raw values
};

/// An echo model: PaperModel (simulate/paper/paper_model.h) or CalibratedModel
/// (simulate/calibrated/model.h). It turns the trace of a ping into an image. Models are immutable;
/// any number of threads may form images at once.
class EchoModel {
  public:
    virtual ~EchoModel() = default;

    EchoModelInfo info;

    /// Fills the image [range bins, beams] of `ping`, which must be 0, its counts and its seconds.
    virtual void form(const TracedPing& traced, const FormContext& context, Ping& ping) const = 0;
    /// Hands the echoes of a traced ping to `use`, direct ones first, for labels: before beam
    /// pattern and pulse spread them and without random terms. Echoes of one bin have one unit.
    virtual SurfaceEchoes surface_echoes(const TracedPing& traced, const View& view,
                                         const Scene& scene, const EchoRequest& request,
                                         const UseEchoes& use) const = 0;
    /// This model with the data that depend on the scene alone, found once for all pings; nullptr
    /// if it needs none. A model that was not prepared forms the same images, slower.
    virtual std::shared_ptr<const EchoModel> prepared(const Scene& /*scene*/) const { return {}; }

    /// The signal of a pixel and the size of its noise. `clean` is the value of the pixel without
    /// the noise of pixels, `noisy` its value with that noise.
    struct SignalAndNoise {
        double signal, noise;
    };
    virtual SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                            int beam) const = 0;

    /// Adds the meaning of an image's values to the sensor's block in dataset.json.
    virtual void describe(nlohmann::ordered_json& /*sensor*/) const {}
    /// The integers that the instrument delivers (raw/ and raw.npy), [range bins, beams].
    virtual std::vector<std::uint16_t> raw(const Ping& /*ping*/) const { return {}; }
};

}  // namespace sonarsim
