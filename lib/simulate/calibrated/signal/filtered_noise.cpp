#include "simulate/calibrated/signal/filtered_noise.h"

namespace sonarsim {

FilteredNoise::FilteredNoise(const NoiseChannels& channels, const std::vector<float>& taps,
                             PhiloxKey key)
    : channels_(channels),
      taps_(taps),
      key_(key),
      reach_(static_cast<int>(taps.size() / 2)),
      length_(lanes * (1 + (2 * reach_ + lanes - 1) / lanes)),
      windows_(static_cast<std::size_t>(2) * length_ * channels.count()),
      a_(static_cast<std::size_t>(lanes) * channels.firsts),
      b_(a_.size()) {}

void FilteredNoise::go_to(int row) {
    const int begin = row - reach_;
    const int end = begin + length_;
    for (int from = row == next_row_ ? end - lanes : begin; from < end; from += lanes)
        draw(from);
    next_row_ = row + lanes;
}

void FilteredNoise::draw(int row) {
    for (int number = 0; number < channels_.firsts; ++number) {
        for (int lane = 0; lane < lanes; ++lane) {
            a_[number * lanes + lane] = static_cast<std::uint32_t>(row + lane);
            b_[number * lanes + lane] = static_cast<std::uint32_t>(number);
        }
    }
    philox_pairs(a_.data(), b_.data(), a_.size(), key_);
    int channel = 0;
    for (int number = 0; number < channels_.firsts; ++number)
        put(channel++, a_.data() + static_cast<std::ptrdiff_t>(lanes) * number);
    for (int number = 0; number < channels_.seconds; ++number)
        put(channel++, b_.data() + static_cast<std::ptrdiff_t>(lanes) * number);
}

void FilteredNoise::put(int channel, const std::uint32_t* words) {
    const auto [re, im] = complex_normals(load_words(words));
    float* const window = windows_.data() + static_cast<std::ptrdiff_t>(2) * length_ * channel;
    // Shifts both parts as one by 8; the last 8 are overwritten below. Faster than memmove().
    float* const end = window + static_cast<std::ptrdiff_t>(2) * length_;
    for (float* to = window; to + lanes < end; to += lanes)
        Floats8::load(to + lanes).store(to);
    re.store(window + length_ - lanes);
    im.store(end - lanes);
}

ComplexLanes FilteredNoise::of(int channel) const {
    const float* const re = windows_.data() + static_cast<std::ptrdiff_t>(2) * length_ * channel;
    const float* const im = re + length_;
    Floats8 sum_re = 0.0F;
    Floats8 sum_im = 0.0F;
    for (std::size_t t = 0; t < taps_.size(); ++t) {
        const Floats8 tap = taps_[t];
        sum_re = fma(tap, Floats8::load(re + t), sum_re);
        sum_im = fma(tap, Floats8::load(im + t), sum_im);
    }
    ComplexLanes out;
    sum_re.store(out.re.data());
    sum_im.store(out.im.data());
    return out;
}

}  // namespace sonarsim
