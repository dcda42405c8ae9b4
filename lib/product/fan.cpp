#include "product/fan.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The largest number of bins in range or in azimuth that a pixel averages. Only pixels next to the
/// apex cover more, and their mean hardly changes.
constexpr double most_bins = 128.0;

/// The ratio of the beams that a pixel covers in successive rings.
constexpr double ring_step = 1.125;

/// Number of points that sample the share of a pixel inside the sector.
constexpr int cover_points = 64;

/// The number of a pixel's points inside the sector. The points form a rank-1 lattice, whose
/// projections on either axis do not coincide.
int covered_points(const View& view, const FanFrame& frame, int column, int row) {
    constexpr int count = cover_points;
    constexpr int step = 19;
    int inside = 0;
    for (int k = 0; k < count; ++k) {
        const double right = (k + 0.5) / count - 0.5;
        const double down = (k * step % count + 0.5) / count - 0.5;
        inside +=
            is_inside_sector(view, fan_place(frame, view.range_max_m, column + right, row + down));
    }
    return inside;
}

/// True if an edge of the sector may cross the pixel.
bool is_near_edge(const View& view, const FanFrame& frame, const FanPlace& place) {
    const double aside = std::fabs(0.5 * view.azimuth_rad - std::fabs(place.azimuth_rad));
    const bool full_turn = view.azimuth_rad >= 2.0 * pi;
    return std::fabs(place.range_m - view.range_min_m) < frame.pixel_m ||
           std::fabs(place.range_m - view.range_max_m) < frame.pixel_m ||
           (!full_turn && place.range_m * std::min(aside, 1.0) < 2.0 * frame.pixel_m);
}

/// The ring of pixels that are `extent` beams wide; ring 0 holds those of up to one beam.
std::size_t ring_of(double extent) {
    std::size_t ring = 0;
    double limit = 1.0;
    while (limit < std::min(extent, most_bins)) {
        limit *= ring_step;
        ++ring;
    }
    return ring;
}

/// A pixel of a ring, from the places of its centre in range and in azimuth.
FanMap::Pixel pixel_at(const FanMap& map, const FanMap::Ring& ring, int beams,
                       const KernelPlace& range, const KernelPlace& beam, int covered) {
    static_assert(KernelTable::phases <= 256 && cover_points < 256);
    const int row = range.bin + map.range_kernel.first[range.phase] + map.range_padding;
    const int column = beam.bin + ring.beam_kernel.first[beam.phase] + map.beam_padding;
    return {.first_bin = row * (beams + 2 * map.beam_padding) + column,
            .range_phase = static_cast<std::uint8_t>(range.phase),
            .beam_phase = static_cast<std::uint8_t>(beam.phase),
            .covered = static_cast<std::uint8_t>(covered)};
}

/// Adds a pixel to a ring. Pixels are added in the order of the picture.
void add_pixel(FanMap::Ring& ring, const FanMap::Pixel& pixel, int index) {
    ring.pixels.push_back(pixel);
    const bool goes_on =
        !ring.runs.empty() && ring.runs.back().index + ring.runs.back().count == index;
    goes_on ? void(++ring.runs.back().count) : ring.runs.push_back({index, 1});
}

/// An image with a margin of bins on all sides.
struct PaddedImage {
    std::ptrdiff_t width;
    std::unique_ptr<float[]> values;
};

/// Pads the image by repeating its edges, or by wrapping the beams of a full turn.
PaddedImage padded(const FanMap& map, const Ping& ping) {
    const int beams = ping.beams;
    const int width = beams + 2 * map.beam_padding;
    const int height = ping.range_bins + 2 * map.range_padding;
    const std::size_t size = static_cast<std::size_t>(width) * height;
    PaddedImage out{width, std::make_unique_for_overwrite<float[]>(size)};
    for (int i = 0; i < height; ++i) {
        const int bin = std::clamp(i - map.range_padding, 0, ping.range_bins - 1);
        const float* const from = ping.intensity.data() + static_cast<std::size_t>(bin) * beams;
        float* const to = out.values.get() + static_cast<std::size_t>(i) * width + map.beam_padding;
        // Infinity times a weight of 0 would be NaN.
        for (int j = 0; j < beams; ++j)
            to[j] = std::min(from[j], std::numeric_limits<float>::max());
        for (int j = 0; j < map.beam_padding; ++j) {
            to[-1 - j] = map.full_turn ? to[beams - 1 - j % beams] : to[0];
            to[beams + j] = map.full_turn ? to[j % beams] : to[beams - 1];
        }
    }
    return out;
}

/// A number of taps that is known at compile time.
template <int count>
using Taps = std::integral_constant<int, count>;

constexpr std::size_t block = 256;

/// Writes the values of a ring's pixels, given in order, to their places in the picture.
class RunWriter {
  public:
    RunWriter(const FanMap::Ring& ring, std::vector<std::uint8_t>& picture)
        : run_(ring.runs.begin()), picture_(picture) {}

    void put(std::span<const std::uint8_t> values) {
        while (!values.empty()) {
            const std::size_t count =
                std::min(values.size(), static_cast<std::size_t>(run_->count) - done_);
            std::copy_n(values.begin(), count, picture_.begin() + run_->index + done_);
            values = values.subspan(count);
            done_ += count;
            if (done_ < static_cast<std::size_t>(run_->count)) continue;
            done_ = 0;
            ++run_;
        }
    }

  private:
    std::vector<FanMap::Run>::const_iterator run_;
    std::size_t done_ = 0;  ///< pixels of the run that are written
    std::vector<std::uint8_t>& picture_;
};

/// Computes the means of at most `block` pixels. The numbers of taps are ints or Taps; the number
/// of beam taps is a multiple of 4.
template <class RangeTaps, class BeamTaps>
void take_means(const FanMap& map, RangeTaps range_taps, const KernelTable& beam_kernel,
                BeamTaps beam_taps, std::span<const FanMap::Pixel> pixels, const PaddedImage& bins,
                std::array<float, block>& means) {
    using Four = Eigen::Array4f;
    const float* const range_weights = map.range_kernel.weights.data();
    const float* const beam_weights = beam_kernel.weights.data();
    const float* const values = bins.values.get();
    const std::ptrdiff_t width = bins.width;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        const FanMap::Pixel& pixel = pixels[p];
        const float* const range_weight = range_weights + pixel.range_phase * range_taps;
        const float* const beam_weight = beam_weights + pixel.beam_phase * beam_taps;
        Four sum = Four::Zero();
        for (int b = 0; b < beam_taps; b += 4) {
            const float* const first = values + pixel.first_bin + b;
            Four over_range = range_weight[0] * Eigen::Map<const Four>(first);
            for (int k = 1; k < range_taps; ++k)
                over_range += range_weight[k] * Eigen::Map<const Four>(first + k * width);
            sum += over_range * Eigen::Map<const Four>(beam_weight + b);
        }
        means[p] = sum.sum() * (static_cast<float>(pixel.covered) / cover_points);
    }
}

}  // namespace

FanPlace fan_place(const FanFrame& frame, double range_max_m, double column, double row) {
    const double x = range_max_m - (row + 0.5) * frame.pixel_m;
    const double y = (0.5 * frame.width - (column + 0.5)) * frame.pixel_m;
    return {x, y, std::sqrt(x * x + y * y), arctan2(y, x)};
}

bool is_inside_sector(const View& view, const FanPlace& place) {
    return place.range_m >= view.range_min_m && place.range_m < view.range_max_m &&
           std::fabs(place.azimuth_rad) <= 0.5 * view.azimuth_rad;
}

FanFrame fan_frame(const Sonar& sonar, int width_px) {
    const View& view = sonar.settings.view;
    const SinCos half = sincos(0.5 * view.azimuth_rad);
    const bool wide = view.azimuth_rad > pi;
    const double width_m = 2.0 * view.range_max_m * (wide ? 1.0 : half.sin);
    const double height_m = view.range_max_m * (wide ? 1.0 - half.cos : 1.0);
    const double framed_m = std::max(width_m, 0.5 * height_m);
    FanFrame frame;
    frame.width =
        width_px > 0
            ? width_px
            : static_cast<int>(std::clamp(std::ceil(framed_m / view.bin_m()), 1.0, 1024.0));
    frame.pixel_m = framed_m / frame.width;
    frame.height = static_cast<int>(std::ceil(height_m / frame.pixel_m - 1e-6));
    return frame;
}

FanMap make_fan_map(const Sonar& sonar, int width_px) {
    const View& view = sonar.settings.view;
    FanMap map;
    map.frame = fan_frame(sonar, width_px);
    map.full_turn = view.azimuth_rad >= 2.0 * pi;
    map.range_kernel = make_kernel(std::min(map.frame.pixel_m / view.bin_m(), most_bins), 1);
    map.range_padding = map.range_kernel.taps / 2 + 1;
    const double beams_per_rad = view.beams / view.azimuth_rad;
    const auto beams_across = [&](double range_m) {
        return std::min({map.frame.pixel_m * beams_per_rad / range_m, most_bins,
                         static_cast<double>(view.beams)});
    };
    const double nearest_m = std::max(view.range_min_m - map.frame.pixel_m, 0.0);
    double extent = 1.0;
    for (std::size_t k = 0; k <= ring_of(beams_across(nearest_m)); ++k, extent *= ring_step)
        map.rings.push_back({make_kernel(extent, 4), {}, {}});
    map.beam_padding = map.rings.back().beam_kernel.taps;
    for (int row = 0; row < map.frame.height; ++row) {
        for (int column = 0; column < map.frame.width; ++column) {
            const FanPlace place = fan_place(map.frame, view.range_max_m, column, row);
            const int covered = is_near_edge(view, map.frame, place)
                                    ? covered_points(view, map.frame, column, row)
                                    : (is_inside_sector(view, place) ? cover_points : 0);
            if (covered == 0) continue;
            // The centre of a pixel on the edge may lie outside the sector.
            const double bins = (place.range_m - view.range_min_m) / view.bin_m();
            const double beams = column_at(sonar, place.azimuth_rad);
            FanMap::Ring& ring = map.rings[ring_of(beams_across(place.range_m))];
            add_pixel(ring,
                      pixel_at(map, ring, view.beams,
                               kernel_place(std::clamp(bins, 0.0, view.range_bins - 1e-6)),
                               kernel_place(std::clamp(beams, 0.0, view.beams - 1e-6)), covered),
                      row * map.frame.width + column);
        }
    }
    return map;
}

std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale) {
    const auto scale = static_cast<float>(1.0 / full_scale);
    const PaddedImage bins = padded(map, ping);
    std::vector<std::uint8_t> picture(static_cast<std::size_t>(map.frame.width) * map.frame.height,
                                      0);
    std::array<float, block> means{};
    std::array<std::uint8_t, block> grey;
    const int range_taps = map.range_kernel.taps;
    for (const FanMap::Ring& ring : map.rings) {
        const KernelTable& kernel = ring.beam_kernel;
        RunWriter out(ring, picture);
        for (std::size_t begin = 0; begin < ring.pixels.size(); begin += block) {
            const auto pixels =
                std::span(ring.pixels).subspan(begin, std::min(block, ring.pixels.size() - begin));
            if (range_taps == 3 && kernel.taps == 4) {
                take_means(map, Taps<3>(), kernel, Taps<4>(), pixels, bins, means);
            } else if (range_taps == 4 && kernel.taps == 4) {
                take_means(map, Taps<4>(), kernel, Taps<4>(), pixels, bins, means);
            } else {
                take_means(map, range_taps, kernel, kernel.taps, pixels, bins, means);
            }
            for (std::size_t p = 0; p < block; ++p) {
                const float share = std::min(1.0F, std::max(0.0F, means[p] * scale));
                grey[p] = static_cast<std::uint8_t>(
                    static_cast<std::int32_t>(255.0F * std::sqrt(share) + 0.5F));
            }
            out.put(std::span(grey).first(pixels.size()));
        }
    }
    return picture;
}

}  // namespace sonarsim
