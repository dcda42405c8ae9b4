#include <cmath>
#include <limits>

#include "simulate/product/fan.h"

namespace sonarsim {

namespace {

constexpr std::size_t fan_block = 256;

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
        // Infinity times a share of 0 inside would be NaN.
        for (int j = 0; j < beams; ++j)
            to[j] = std::min(from[j], std::numeric_limits<float>::max());
        for (int j = 0; j < map.beam_padding; ++j) {
            to[-1 - j] = map.full_turn ? to[beams - 1 - j % beams] : to[0];
            to[beams + j] = map.full_turn ? to[j % beams] : to[beams - 1];
        }
    }
    return out;
}

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

/// The mean of `rows` x `beams` bins. Equal bins have their own value as the mean.
float mean_of(const PaddedImage& bins, std::int32_t first_bin, int rows, int beams) {
    const float* row = bins.values.get() + first_bin;
    float sum = 0.0F;
    for (int i = 0; i < rows; ++i, row += bins.width) {
        for (int j = 0; j < beams; ++j)
            sum += row[j];
    }
    return sum / static_cast<float>(rows * beams);
}

/// The grey value of a pixel: 255 sqrt(scale * mean), rounded.
std::uint8_t grey_of(float mean, float scale) {
    // In this order of arguments NaN becomes 0.
    const float share = std::min(std::max(0.0F, scale * mean), 1.0F);
    return static_cast<std::uint8_t>(static_cast<int>(255.0F * std::sqrt(share) + 0.5F));
}

void draw_ring(const FanMap& map, const FanMap::Ring& ring, const PaddedImage& bins, float scale,
               std::vector<std::uint8_t>& picture) {
    std::array<float, fan_block> means{};
    std::array<std::uint8_t, fan_block> grey;
    RunWriter out(ring, picture);
    auto edge = ring.edges.begin();
    for (std::size_t begin = 0; begin < ring.pixels.size(); begin += fan_block) {
        const auto pixels =
            std::span(ring.pixels).subspan(begin, std::min(fan_block, ring.pixels.size() - begin));
        for (std::size_t p = 0; p < pixels.size(); ++p)
            means[p] = mean_of(bins, pixels[p], map.range_bins, ring.beams);
        for (; edge != ring.edges.end() && edge->pixel < begin + pixels.size(); ++edge)
            means[edge->pixel - begin] *= edge->covered;
        for (std::size_t p = 0; p < pixels.size(); ++p)
            grey[p] = grey_of(means[p], scale);
        out.put(std::span(grey).first(pixels.size()));
    }
}

}  // namespace

std::vector<std::uint8_t> render_fan(const FanMap& map, const Ping& ping, double full_scale) {
    const auto scale = static_cast<float>(1.0 / full_scale);
    const PaddedImage bins = padded(map, ping);
    std::vector<std::uint8_t> picture(static_cast<std::size_t>(map.frame.width) * map.frame.height,
                                      0);
    for (const FanMap::Ring& ring : map.rings)
        draw_ring(map, ring, bins, scale, picture);
    return picture;
}

std::vector<std::uint8_t> display_fan(const FanMap& map, const EchoModel& model, const Ping& ping,
                                      double full_scale) {
    if (model.info.raw_bits == 0) return render_fan(map, ping, full_scale);
    // render_fan() takes the root of mean powers.
    Ping shown;
    shown.range_bins = ping.range_bins;
    shown.beams = ping.beams;
    shown.intensity.reserve(ping.intensity.size());
    const float scale = 1.0F / static_cast<float>((1 << model.info.raw_bits) - 1);
    for (const std::uint16_t value : model.raw(ping)) {
        const float share = scale * static_cast<float>(value);
        shown.intensity.push_back(share * share);
    }
    return render_fan(map, shown, 1.0);
}

}  // namespace sonarsim
