#include "calibrate/patch_classes.h"

#include <set>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double least_echo_db = 6.0;

/// True for a patch that has beams with noise that all elements share.
bool straight_ahead(const PatchMoments& patch, const PatchSize& size, const AheadBeams& ahead) {
    return patch.beam < ahead.end && ahead.first < patch.beam + size.beams;
}

/// True if all rows of a patch are in these blocks.
bool all_rows_in(const PatchMoments& patch, int rows, const std::set<int>& blocks) {
    for (int row = patch.row; row < patch.row + rows; row += rows_of_noise_block) {
        if (!blocks.contains(row)) return false;
    }
    return true;
}

}  // namespace

double range_of_row(const Recording& recording, int row) {
    return recording.first_range_m + row * recording.range_step_m;
}

std::vector<double> beam_sines(const Recording& recording) {
    std::vector<double> out;
    if (recording.kind != RecordedKind::imaging) return out;
    for (const double bearing : recording.bearing_rad)
        out.push_back(sincos(bearing).sin);
    return out;
}

PatchClasses classified(const Recording& recording, const LawFit& law,
                        const std::optional<NoiseFit>& noise) {
    const double full_value = full_value_of(recording);
    PatchClasses out;
    const PatchGrid grid = speckle_grid(recording.pings.front());
    out.places = grid.places();
    out.patches = patch_moments(recording.pings, full_value, [&](double v, int row) {
        const double level_db = noise ? noise->at(range_of_row(recording, row)) : 0.0;
        return law.log_power(v, full_value) - level_db / db_of_e;
    });
    std::set<int> blocks;
    if (noise) {
        for (const NoiseBlock& block : noise->used) {
            if (block.without_echo && block.without_zeros) blocks.insert(block.row);
        }
    }
    for (std::size_t k = 0; k < out.patches.size(); ++k) {
        const PatchMoments& patch = out.patches[k];
        if (noise && all_rows_in(patch, grid.size.ranges, blocks) &&
            !straight_ahead(patch, grid.size, noise->ahead))
            out.noise.push_back(k);
    }
    // Particles in the water are bright points in some of them.
    out.noise = without_uneven(out.patches, out.noise);
    for (const std::size_t k : speckle_patches(out.patches, full_value > 15.0 ? 6.0 : 0.0)) {
        const PatchMoments& patch = out.patches[k];
        const double above_db = db_of_e * (patch.mean - law.statistics.mean);
        if (!noise || above_db > least_echo_db) out.echoes.push_back(k);
    }
    return out;
}

}  // namespace sonarsim
