#include "compare/measure_images.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrated/decibel.h"
#include "compare/figures/points.h"
#include "compare/figures/texture.h"
#include "compare/measure_edges.h"
#include "compare/measure_patches.h"
#include "compare/measure_shadows.h"
#include "core/text.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr int range_bands = 12;
constexpr int bearing_bands = 8;
constexpr double homogeneous = 0.35;  ///< trend of a patch of water or tail
constexpr double uneven = 0.5;        ///< trend of a patch of the bottom
constexpr double least_level_power = 1e-16;

/// "0.5".
std::string short_number(double value) {
    return number_text(std::round(value * 100.0) / 100.0);
}

/// The levels of bands. A cell is the part of a patch in one band; choose(i, j) is the band of a
/// pixel, -1 for none.
template <class Choose>
std::vector<Measured> banded_levels(const RecordedImages& images, PatchSize size,
                                    const std::vector<std::string>& names, const Choose& choose) {
    std::vector<Measured> bands;
    bands.reserve(names.size());
    for (const std::string& name : names)
        bands.push_back({name, Reduce::level, Tolerance::decibel, 0.5, {}});
    std::vector<double> sums(names.size());
    std::vector<double> counts(names.size());
    const PatchGrid grid = images.grid(size);
    for (std::size_t k = 0; k < images.powers.size(); ++k) {
        for (int place = 0; place < grid.places(); ++place) {
            std::ranges::fill(sums, 0.0);
            std::ranges::fill(counts, 0.0);
            grid.for_each_bin(images.image(k), place, [&](float power, int i, int j) {
                const int band = choose(i, j);
                if (band < 0) return;
                sums[static_cast<std::size_t>(band)] += power;
                counts[static_cast<std::size_t>(band)] += 1.0;
            });
            for (std::size_t b = 0; b < bands.size(); ++b) {
                if (counts[b] == 0.0) continue;
                bands[b].cells.push_back({place, static_cast<int>(k),
                                          static_cast<float>(sums[b] / counts[b]),
                                          static_cast<float>(counts[b])});
            }
        }
    }
    return bands;
}

void append(std::vector<Measured> figures, Measurement& out) {
    for (Measured& figure : figures) {
        if (!figure.cells.empty()) out.figures.push_back(std::move(figure));
    }
}

void measure_levels(const RecordedImages& images, const MeasureOptions& options, Measurement& out) {
    const Zones& z = options.zones;
    const bool is_one = z.water.to == z.water.from && z.tail.to == z.tail.from;
    const auto zone_at = [&](int i) {
        if (z.bottom.holds(i, i + 1)) return 0;
        if (z.water.holds(i, i + 1)) return 1;
        if (i < z.water.from) return 3;
        return z.tail.holds(i, i + 1) ? 2 : -1;
    };
    append(banded_levels(images, options.patch,
                         {is_one ? "image: level, dB" : "bottom: level, dB", "water: level, dB",
                          "tail: level, dB", "ring: level, dB"},
                         [&](int i, int) { return zone_at(i); }),
           out);
    const CommonBands& b = options.bands;
    const auto band_of = [](double value, double from, double to, int count) {
        const double share = (value - from) / (to - from);
        return share >= 0.0 && share < 1.0 ? static_cast<int>(share * count) : -1;
    };
    std::vector<std::string> names;
    for (int k = 0; k < range_bands; ++k) {
        const double step = (b.range_to_m - b.range_from_m) / range_bands;
        names.push_back("level at " + short_number(b.range_from_m + k * step) + " to " +
                        short_number(b.range_from_m + (k + 1) * step) + " m, dB");
    }
    append(banded_levels(images, options.patch, names,
                         [&](int i, int) {
                             const double range = images.first_range_m + i * images.range_step_m;
                             return band_of(range, b.range_from_m, b.range_to_m, range_bands);
                         }),
           out);
    if (images.bearing_rad.empty() || b.bearing_from_rad == b.bearing_to_rad) return;
    names.clear();
    for (int k = 0; k < bearing_bands; ++k) {
        const double step = (b.bearing_to_rad - b.bearing_from_rad) / bearing_bands;
        const double from = b.bearing_from_rad + k * step;
        names.push_back("bottom: level at " + short_number(from * 180.0 / pi) + " to " +
                        short_number((from + step) * 180.0 / pi) + " degrees, dB");
    }
    append(banded_levels(images, options.patch, names,
                         [&](int i, int j) {
                             if (zone_at(i) != 0) return -1;
                             return band_of(images.bearing_rad[static_cast<std::size_t>(j)],
                                            b.bearing_from_rad, b.bearing_to_rad, bearing_bands);
                         }),
           out);
}

void measure_shares(const RecordedImages& images, PatchSize size, Measurement& out) {
    Measured zeros{"share of zeros", Reduce::mean, Tolerance::share, 0.5, {}};
    Measured clipped{"share of clipped values", Reduce::mean, Tolerance::share, 0.5, {}};
    const PatchGrid grid = images.grid(size);
    for (std::size_t k = 0; k < images.powers.size(); ++k) {
        for (int place = 0; place < grid.places(); ++place) {
            int empty = 0;
            int full = 0;
            grid.for_each_bin(images.image(k), place, [&](float power, int, int) {
                empty += power > images.least_power ? 0 : 1;
                full += images.full_power > 0.0F && power >= images.full_power ? 1 : 0;
            });
            const float share = 1.0F / static_cast<float>(size.values());
            const int ping = static_cast<int>(k);
            zeros.cells.push_back({place, ping, share * static_cast<float>(empty), 1.0F});
            clipped.cells.push_back({place, ping, share * static_cast<float>(full), 1.0F});
        }
    }
    out.figures.push_back(std::move(zeros));
    if (images.full_power > 0.0F) out.figures.push_back(std::move(clipped));
}

/// The histogram of levels, and percentiles of it. The bins are 0.5 dB wide, from -160 dB on.
void measure_histograms(const RecordedImages& images, PatchSize size, Measurement& out) {
    constexpr int bins = 340;
    constexpr double bin_db = 0.5;
    constexpr double lowest_db = -160.0;
    MeasuredHistogram levels{"levels", bin_db, "dB", {}};
    MeasuredHistogram texture{"texture", 1.0, "patterns", {}};
    const PatchGrid grid = images.grid(size);
    const auto places = static_cast<std::size_t>(grid.places());
    levels.counts.assign(places, std::vector<double>(bins));
    texture.counts.assign(places, std::vector<double>(texture_patterns));
    for (std::size_t k = 0; k < images.powers.size(); ++k) {
        const ImageView image = images.image(k);
        for (std::size_t b = 0; b < places; ++b) {
            const int place = static_cast<int>(b);
            grid.for_each_bin(image, place, [&](float power, int, int) {
                const double level =
                    10.0 / ln_10 *
                    natural_log(std::max(power, static_cast<float>(least_level_power)));
                const int bin = static_cast<int>((level - lowest_db) / bin_db + 0.5);
                levels.counts[b][static_cast<std::size_t>(std::clamp(bin, 0, bins - 1))] += 1.0;
            });
            const auto own = texture_histogram(image, grid, place);
            for (std::size_t t = 0; t < own.size(); ++t)
                texture.counts[b][t] += own[t];
        }
    }
    for (const int percent : {5, 25, 50, 75, 95, 99}) {
        Measured figure{"level of " + std::to_string(percent) + " % of the image, dB",
                        Reduce::quantile,
                        Tolerance::decibel,
                        percent / 100.0,
                        {}};
        for (std::size_t b = 0; b < places; ++b) {
            for (std::size_t i = 0; i < bins; ++i) {
                if (levels.counts[b][i] > 0.0)
                    figure.cells.push_back(
                        {static_cast<int>(b), 0,
                         static_cast<float>(lowest_db + bin_db * static_cast<double>(i)),
                         static_cast<float>(levels.counts[b][i])});
            }
        }
        out.figures.push_back(std::move(figure));
    }
    out.histograms.push_back(std::move(levels));
    out.histograms.push_back(std::move(texture));
}

void measure_points(const RecordedImages& images, const MeasureOptions& options, Measurement& out) {
    if (images.columns_are_pings) return;
    Measured beams{"points: width, beams", Reduce::quantile, Tolerance::tenth, 0.5, {}};
    Measured ranges{"points: width, ranges", Reduce::quantile, Tolerance::tenth, 0.5, {}};
    Measured lobes{"points: side lobes, dB", Reduce::quantile, Tolerance::decibel, 0.5, {}};
    const RangeZone zone = options.zones.water.to > options.zones.water.from ? options.zones.water
                                                                             : options.zones.bottom;
    const PatchGrid grid = images.grid(options.patch);
    for (std::size_t k = 0; k < images.powers.size(); ++k) {
        for (const PointEcho& point : point_echoes(images.image(k), zone.from, zone.to)) {
            const int place = grid.place_of(point.range, point.beam);
            const int ping = static_cast<int>(k);
            beams.cells.push_back({place, ping, static_cast<float>(point.width_beams), 1.0F});
            ranges.cells.push_back({place, ping, static_cast<float>(point.width_ranges), 1.0F});
            lobes.cells.push_back({place, ping, static_cast<float>(point.side_lobes_db), 1.0F});
        }
    }
    append({std::move(beams), std::move(ranges), std::move(lobes)}, out);
}

}  // namespace

Measurement measure_images(const RecordedImages& images, const MeasureOptions& options) {
    Measurement out;
    out.first_range_m = images.first_range_m;
    out.range_step_m = images.range_step_m;
    for (const double power : mean_powers_of(images))
        out.level_by_range_db.push_back(db_of_power(std::max(least_level_power, power)));
    const Zones& z = options.zones;
    const bool is_one = z.water.to == z.water.from && z.tail.to == z.tail.from;
    measure_zone(images, options.patch, z.bottom, is_one ? "image" : "bottom", uneven, out);
    measure_zone(images, options.patch, z.water, "water", homogeneous, out);
    measure_zone(images, options.patch, z.tail, "tail", homogeneous, out);
    measure_levels(images, options, out);
    measure_shares(images, options.patch, out);
    measure_histograms(images, options.patch, out);
    measure_points(images, options, out);
    measure_edges(images, options.patch, z, out);
    if (images.has_shadows) measure_shadows(images, options.patch, z, out);
    return out;
}

}  // namespace sonarsim
