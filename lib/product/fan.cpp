#include "product/fan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// A tap is the index of a bin, then the bin's weight less one in the low bits. 64 is the weight of
// a bin that fills its pixel.
constexpr int weight_bits = 6;
constexpr std::uint32_t whole = 1U << weight_bits;
constexpr std::uint32_t weight_mask = whole - 1;

/// The points of one pixel at which bins are looked up, relative to its centre: a rank-1
/// lattice, whose projections on either axis (and so on an edge) do not coincide.
template <int count, int step>
struct Points {
    std::array<double, count> right{};
    std::array<double, count> down{};

    constexpr Points() {
        for (int k = 0; k < count; ++k) {
            right[k] = (k + 0.5) / count - 0.5;
            down[k] = (k * step % count + 0.5) / count - 0.5;
        }
    }
};
constexpr Points<16, 7> coarse_points;
constexpr Points<64, 19> fine_points;  // where several bins share a pixel

/// Finds the bins under a pixel.
class Sampler {
  public:
    Sampler(const View& view, int width, double pixel_m)
        : view_(view),
          half_width_(0.5 * width),
          pixel_m_(pixel_m),
          bins_per_m_(1.0 / view.bin_m()),
          beams_per_rad_(view.beams / view.azimuth_rad) {}

    /// The taps of pixel (column, row), sorted by bin.
    const std::vector<std::uint32_t>& taps(int column, int row) {
        const double x = view_.range_max_m - (row + 0.5) * pixel_m_;
        const double y = (half_width_ - (column + 0.5)) * pixel_m_;
        const double r = std::sqrt(x * x + y * y);
        bins_.clear();
        if (r > view_.range_max_m + pixel_m_ || r < view_.range_min_m - pixel_m_) return bins_;
        const double azimuth = arctan2(y, x);
        if (r * (std::fabs(azimuth) - 0.5 * view_.azimuth_rad) > pixel_m_) return bins_;
        const double bin_m = std::min(view_.bin_m(), r / beams_per_rad_);
        bin_m < 0.5 * pixel_m_ ? look_up(fine_points, x, y, azimuth)
                               : look_up(coarse_points, x, y, azimuth);
        return bins_;
    }

  private:
    /// The bins at points of the pixel whose centre is (x, y).
    template <int count, int step>
    void look_up(const Points<count, step>& points, double x, double y, double azimuth) {
        std::array<double, count> range;
        std::array<double, count> beam;
        const double first_beam = (azimuth + 0.5 * view_.azimuth_rad) * beams_per_rad_;
        const double full_turn = 2.0 * pi * beams_per_rad_;
        const bool near_apex = x * x + y * y < 64.0 * pixel_m_ * pixel_m_;
        for (int k = 0; k < count; ++k) {
            const double px = x - points.down[k] * pixel_m_;
            const double py = y - points.right[k] * pixel_m_;
            range[k] = (std::sqrt(px * px + py * py) - view_.range_min_m) * bins_per_m_;
            // The angle from the centre is small: three terms of the arctangent are exact to 1e-8.
            const double t = (x * py - y * px) / (x * px + y * py);
            const double t2 = t * t;
            beam[k] = first_beam + t * (1.0 - t2 * (1.0 / 3.0 - t2 / 5.0)) * beams_per_rad_;
        }
        for (int k = 0; k < count && near_apex; ++k) {
            const double px = x - points.down[k] * pixel_m_;
            const double py = y - points.right[k] * pixel_m_;
            beam[k] = (arctan2(py, px) + 0.5 * view_.azimuth_rad) * beams_per_rad_;
        }
        for (int k = 0; k < count; ++k) {
            // Behind the apex of a full circle the last beam meets the first.
            const double turn = beam[k] < 0.0 ? full_turn : beam[k] >= full_turn ? -full_turn : 0.0;
            const double j = beam[k] + turn;
            if (!(range[k] >= 0.0 && range[k] < view_.range_bins)) continue;
            if (!(j >= 0.0 && j < view_.beams)) continue;
            const auto bin = static_cast<std::uint32_t>(static_cast<int>(range[k]) * view_.beams +
                                                        static_cast<int>(j));
            add(bin, whole / count);
        }
        std::sort(bins_.begin(), bins_.end());
    }

    void add(std::uint32_t bin, std::uint32_t weight) {
        for (std::uint32_t& tap : bins_) {
            if (tap >> weight_bits == bin) {
                tap += weight;
                return;
            }
        }
        bins_.push_back(bin << weight_bits | (weight - 1));
    }

    View view_;
    double half_width_;
    double pixel_m_;
    double bins_per_m_;
    double beams_per_rad_;
    std::vector<std::uint32_t> bins_;
};

}  // namespace

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
    FanMap map;
    map.frame = fan_frame(sonar, width_px);
    const auto [width, height, pixel_m] = map.frame;
    // Taps by pixel in raster order first; then transposed, group by group.
    struct Entry {
        std::int32_t pixel;
        std::uint32_t first;
        std::uint32_t count;
    };
    std::vector<Entry> entries;
    std::vector<std::uint32_t> raster;
    Sampler sampler(sonar.settings.view, width, pixel_m);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const std::vector<std::uint32_t>& taps = sampler.taps(column, row);
            if (taps.empty()) continue;
            entries.push_back({row * width + column, static_cast<std::uint32_t>(raster.size()),
                               static_cast<std::uint32_t>(taps.size())});
            raster.insert(raster.end(), taps.begin(), taps.end());
        }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.count < b.count; });
    map.taps.reserve(raster.size());
    for (std::size_t begin = 0; begin < entries.size();) {
        const std::uint32_t count = entries[begin].count;
        std::size_t end = begin;
        while (end < entries.size() && entries[end].count == count)
            ++end;
        map.groups.push_back({count, begin, end - begin, map.taps.size()});
        for (std::uint32_t k = 0; k < count; ++k) {
            for (std::size_t p = begin; p < end; ++p)
                map.taps.push_back(raster[entries[p].first + k]);
        }
        begin = end;
    }
    for (const Entry& entry : entries)
        map.pixel.push_back(entry.pixel);
    return map;
}

std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale) {
    constexpr std::size_t block = 256;
    const float scale = static_cast<float>(1.0 / (full_scale * whole));
    const float* const intensity = ping.intensity.data();
    std::vector<std::uint8_t> image(static_cast<std::size_t>(map.frame.width) * map.frame.height,
                                    0);
    std::array<float, block> sum;
    std::array<std::uint8_t, block> grey;
    for (const FanMap::Group& group : map.groups) {
        for (std::size_t begin = 0; begin < group.pixels; begin += block) {
            const std::size_t count = std::min(block, group.pixels - begin);
            sum.fill(0.0F);
            for (std::size_t k = 0; k < group.taps_per_pixel; ++k) {
                const std::uint32_t* const taps =
                    map.taps.data() + group.first_tap + k * group.pixels + begin;
                for (std::size_t p = 0; p < count; ++p) {
                    const auto bin = static_cast<std::int32_t>(taps[p] >> weight_bits);
                    const auto weight = static_cast<std::int32_t>((taps[p] & weight_mask) + 1);
                    sum[p] += static_cast<float>(weight) * intensity[bin];
                }
            }
            for (std::size_t p = 0; p < block; ++p) {
                const float share = std::min(1.0F, std::max(0.0F, sum[p] * scale));
                grey[p] = static_cast<std::uint8_t>(
                    static_cast<std::int32_t>(255.0F * std::sqrt(share) + 0.5F));
            }
            const std::int32_t* const pixel = map.pixel.data() + group.first_pixel + begin;
            for (std::size_t p = 0; p < count; ++p)
                image[pixel[p]] = grey[p];
        }
    }
    return image;
}

}  // namespace sonarsim
