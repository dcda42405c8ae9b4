#pragma once

#include "simulate/calibrated/model.h"
#include "support/sonars.h"

namespace sonarsim::test {

/// An instrument whose image is the mean echo: no noise, no TVG, no speckle, no texture.
inline InstrumentConfig bare(InstrumentConfig instrument) {
    instrument.receiver.noise_db = -300.0;
    if (!instrument.receiver.full_scale_db) instrument.receiver.full_scale_db = 0.0;
    if (!instrument.source_level_db) instrument.source_level_db = 0.0;
    instrument.receiver.tvg_log = 0.0;
    instrument.receiver.tvg_absorption = false;
    instrument.speckle.mode = SpeckleMode::none;
    instrument.speckle.texture = 0.0;
    return instrument;
}

inline SonarConfig calibrated(SonarConfig config, double frequency_hz) {
    config.model = ModelKind::calibrated;
    config.instrument.frequency_hz = frequency_hz;
    config.instrument.speckle.texture = 0.0;
    return config;
}

/// A calibrated sonar whose image is the mean echo.
inline SonarConfig bare_sonar(SonarConfig config, double frequency_hz) {
    config = calibrated(std::move(config), frequency_hz);
    config.instrument = bare(config.instrument);
    return config;
}

/// The model of a calibrated sonar.
inline const CalibratedModel& calibrated_model_of(const Sonar& sonar) {
    return dynamic_cast<const CalibratedModel&>(*sonar.settings.model);
}

/// A floor of a bed alone, at the height z.
inline Scene bed_scene(const Material& bed, float half_size, double z, int n = 4) {
    Scene scene = empty_scene();
    scene.materials = {bed};
    add_floor(scene, half_size, static_cast<float>(z), 0, n);
    return scene;
}

/// The rows and columns of an image [range bins, beams].
inline Eigen::Map<const Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
image_array(const std::vector<float>& image, int beams) {
    return {image.data(), std::ssize(image) / beams, beams};
}

/// The sines of beams that divide a fan into equal angles.
inline BeamSines fan_sines(double azimuth_deg, int beams) {
    BeamSines sines;
    for (int k = 0; k <= 2 * beams; ++k) {
        (k % 2 == 0 ? sines.edges : sines.middles)
            .push_back(std::sin(radians(azimuth_deg * (0.5 * k / beams - 0.5))));
    }
    return sines;
}

/// A scene without surface, for samples of its only material.
inline Scene scene_of_rock() {
    Scene scene;
    scene.materials.push_back({.name = "rock", .reflection = 0.4F});
    return scene;
}

/// The image [range bins, beams] that a model makes of what was traced.
inline std::vector<float> image_of_traced(const EchoModel& model, const View& view,
                                          const TracedPing& traced, const Terms& terms,
                                          const PingDraws& draws = {1, 2, 0},
                                          const Scene& scene = scene_of_rock()) {
    Ping ping;
    ping.range_bins = view.range_bins;
    ping.beams = view.beams;
    ping.intensity.resize(static_cast<std::size_t>(view.range_bins) * view.beams);
    model.form(traced, {.view = view, .scene = scene, .draws = draws, .terms = terms}, ping);
    return ping.intensity;
}

/// The image [range bins, beams] that a model makes of samples of `scene_of_rock()`.
inline std::vector<float> image_of_samples(const CalibratedModel& model, const View& view,
                                           const Samples& samples, const Terms& terms,
                                           const Pose& pose = {},
                                           const PingDraws& draws = {1, 2, 0}) {
    TracedPing traced;
    traced.T_world_sensor = pose;
    traced.samples = samples;
    return image_of_traced(model, view, traced, terms, draws);
}

/// The image of an engine, as a rule the expected one, without speckle, noise and multipath.
inline std::vector<float> expected_image(const Sonar& sonar, const Scene& scene, EngineKind type,
                                         const Pose& pose = {},
                                         const Terms& terms = direct_echoes_alone) {
    return render_ping(sonar, scene, *engine_of(scene, type), pose, {.seed = 1, .ping = 0}, terms)
        .intensity;
}

}  // namespace sonarsim::test
