#include "compare/advice.h"

#include <array>
#include <string_view>

namespace sonarsim {

namespace {

struct Rule {
    std::string_view zone;  ///< begin of the figure's name; empty: any
    std::string_view part;  ///< text in it
    std::string_view keys;
};

constexpr std::string_view levels_of_noise =
    "instrument.receiver.noise_db, common_mode_db, tvg_log, tvg_from_m, full_scale_db";
constexpr std::string_view levels_of_bottom =
    "instrument.source_level_db, instrument.receiver.full_scale_db, the material's lambert_db";

// The first rule that matches applies.
constexpr std::array rules{
    Rule{"points", "beams", "instrument.beam.width_deg, aberration_rad"},
    Rule{"points", "ranges", "instrument.pulse.resolution_m, range_bins"},
    Rule{"points", "side lobes", "instrument.beam.side_lobe_db, elements"},
    Rule{"edges", "degrees", "instrument.beam.width_deg, aberration_rad"},
    Rule{"edges", " m", "instrument.pulse.resolution_m, range_bins"},
    Rule{"shadows", "depth",
         "instrument.receiver.noise_db, instrument.beam.side_lobe_db, elements; water.content"},
    Rule{"shadows", "edge", "instrument.pulse.resolution_m, range_bins, instrument.beam.width_deg"},
    Rule{"shadows", "", "the scene's objects, the altitude"},
    Rule{"", "spread of ranges",
         "the bed's roughness; instrument.pulse.resolution_m, instrument.beam.width_deg"},
    Rule{"", "degrees: level",
         "the material's scattering; instrument.beam, instrument.source_level_db"},
    Rule{"", "degrees: variation", "instrument.receiver.looks, instrument.speckle.clutter_shape"},
    Rule{"", "next ping",
         "instrument.speckle.mode, the trajectory's motion, instrument.receiver.noise_db"},
    Rule{"", "ranges", "instrument.pulse.resolution_m, instrument.receiver.samples, range_bins"},
    Rule{"", "beams", "instrument.beam.width_deg, side_lobe_db, azimuth_bins"},
    Rule{"", " pings",
         "instrument.beam.width_deg, the speed of the trajectory, "
         "instrument.receiver.gain_drift_db"},
    Rule{"", "K shape", "instrument.speckle.clutter_shape, per_cell"},
    Rule{"", "variation of amplitude",
         "instrument.receiver.looks, samples, combine, companding; "
         "instrument.speckle.clutter_shape"},
    Rule{"", "Weibull",
         "instrument.receiver.looks, samples, combine, companding; "
         "instrument.speckle.clutter_shape"},
    Rule{"", "scintillation",
         "instrument.speckle.clutter_shape, per_cell; instrument.receiver.looks"},
    Rule{"", "spread of levels", "instrument.receiver.looks, samples, offset, bits"},
    Rule{"", "zeros", "instrument.receiver.noise_db, offset, bits, blanking_m"},
    Rule{"", "clipped", "instrument.receiver.full_scale_db"},
    Rule{"ring", "level", "instrument.receiver.ring_down_db, ring_down_m, blanking_m"},
    Rule{"water", "level", levels_of_noise},
    Rule{"tail", "level",
         "instrument.beam.elevation_side_lobe_db, instrument.receiver.noise_db, tvg_log"},
    Rule{"bottom", "level at",
         "instrument.beam.elevation_width_deg, the mount's attitude, the material's scattering"},
    Rule{"bottom", "level", levels_of_bottom},
    Rule{
        "level at", "",
        "instrument.receiver.tvg_log, noise_db, full_scale_db, ring_down_db; the scene's distance"},
    Rule{"", "level", levels_of_bottom},
};

}  // namespace

std::string keys_behind(const std::string& figure) {
    for (const Rule& rule : rules) {
        if (figure.starts_with(rule.zone) && figure.find(rule.part) != std::string::npos)
            return std::string(rule.keys);
    }
    return "scene, instrument";
}

}  // namespace sonarsim
