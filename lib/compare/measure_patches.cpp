#include "compare/measure_patches.h"

#include <array>
#include <cmath>
#include <optional>

#include "compare/figures/amplitude.h"
#include "compare/figures/correlation.h"
#include "core/in_parallel.h"

namespace sonarsim {

namespace {

constexpr double most_clipped = 0.03;
constexpr std::array lags{1, 2, 4};

// The figures of a patch, in this order.
enum PatchFigure {
    variation,
    weibull,
    inverse_k,
    scintillation_index,
    level_spread,
    first_correlation,
    patch_figures = first_correlation + 7
};

using PatchValues = std::array<double, patch_figures>;

PatchValues values_of(const Patch& patch, PatchSize size) {
    PatchValues out;
    out[variation] = amplitude_moments(patch.amplitude).variation;
    out[weibull] = weibull_shape(patch.amplitude);
    out[inverse_k] = inverse_k_shape(patch.amplitude);
    out[scintillation_index] = scintillation(patch.amplitude);
    out[level_spread] = spread_db(patch.amplitude);
    for (std::size_t k = 0; k < lags.size(); ++k) {
        out[first_correlation + k] = range_correlation(patch.amplitude, size, lags[k]);
        out[first_correlation + lags.size() + k] = beam_correlation(patch.amplitude, size, lags[k]);
    }
    out[first_correlation + 2 * lags.size()] = std::nan("");  // to the next ping
    return out;
}

std::vector<Measured> empty_figures(const std::string& zone, bool columns_are_pings) {
    const std::string across = columns_are_pings ? " pings" : " beams";
    const auto named = [&](const std::string& name, Reduce reduce, Tolerance tolerance) {
        return Measured{zone + ": " + name, reduce, tolerance, 0.5, {}};
    };
    std::vector<Measured> figures{
        named("variation of amplitude", Reduce::quantile, Tolerance::tenth),
        named("Weibull shape", Reduce::quantile, Tolerance::tenth),
        named("inverse K shape", Reduce::quantile, Tolerance::correlation),
        named("scintillation index", Reduce::quantile, Tolerance::tenth),
        named("spread of levels, dB", Reduce::quantile, Tolerance::tenth)};
    for (const int lag : lags)
        figures.push_back(named("correlation over " + std::to_string(lag) + " ranges", Reduce::mean,
                                Tolerance::correlation));
    for (const int lag : lags)
        figures.push_back(named("correlation over " + std::to_string(lag) + across, Reduce::mean,
                                Tolerance::correlation));
    figures.push_back(named("correlation to the next ping", Reduce::mean, Tolerance::correlation));
    return figures;
}

/// The share of a patch that lies at either end of the scale.
double clipped_share_of(const RecordedImages& images, const ImageView& image, const PatchGrid& grid,
                        int place) {
    int clipped = 0;
    grid.for_each_bin(image, place, [&](float power, int, int) {
        const bool is_full = images.full_power > 0.0F && power >= images.full_power;
        clipped += is_full || power <= images.least_power ? 1 : 0;
    });
    return static_cast<double>(clipped) / grid.size.values();
}

/// A patch of one image that counts.
struct FoundPatch {
    PatchValues values;
    std::vector<float> amplitude;
};

/// The patches of one place in all images.
std::vector<std::optional<FoundPatch>> patches_at(const RecordedImages& images,
                                                  const Detrender& detrender, const PatchGrid& grid,
                                                  int place, double most_trend) {
    std::vector<std::optional<FoundPatch>> found(images.powers.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        const ImageView image = images.image(k);
        if (clipped_share_of(images, image, grid, place) > most_clipped) continue;
        std::optional<Patch> patch = detrender.patch_of(image, grid, place);
        if (!patch || patch->trend > most_trend) continue;
        found[k] = FoundPatch{values_of(*patch, grid.size), std::move(patch->amplitude)};
        if (images.columns_are_pings || k == 0 || !found[k - 1]) continue;
        found[k]->values[patch_figures - 1] =
            ping_correlation(found[k]->amplitude, found[k - 1]->amplitude);
        found[k - 1]->amplitude.clear();
    }
    return found;
}

}  // namespace

void measure_zone(const RecordedImages& images, PatchSize size, RangeZone zone,
                  const std::string& name, double most_trend, Measurement& out) {
    const Detrender detrender(size);
    const PatchGrid grid = images.grid(size);
    const int first = (zone.from + size.ranges - 1) / size.ranges * grid.columns;
    const int end = zone.to / size.ranges * grid.columns;
    if (end <= first) return;
    std::vector<std::vector<std::optional<FoundPatch>>> found(
        static_cast<std::size_t>(end - first));
    in_parallel(found.size(), [&](std::size_t k) {
        const int place = first + static_cast<int>(k);
        found[k] = patches_at(images, detrender, grid, place, most_trend);
    });
    std::vector<Measured> figures = empty_figures(name, images.columns_are_pings);
    for (std::size_t place = 0; place < found.size(); ++place) {
        for (std::size_t k = 0; k < found[place].size(); ++k) {
            if (!found[place][k]) continue;
            for (std::size_t f = 0; f < figures.size(); ++f) {
                const auto value = static_cast<float>(found[place][k]->values[f]);
                const int location = first + static_cast<int>(place);
                if (std::isfinite(value))
                    figures[f].cells.push_back({location, static_cast<int>(k), value, 1.0F});
            }
        }
    }
    for (Measured& figure : figures) {
        if (!figure.cells.empty()) out.figures.push_back(std::move(figure));
    }
}

}  // namespace sonarsim
