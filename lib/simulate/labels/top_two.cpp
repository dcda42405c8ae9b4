#include "simulate/labels/top_two.h"

#include <algorithm>

namespace sonarsim {

namespace {

/// Merges the echoes of one key into the two largest.
void keep_top_two(std::span<const float> echo, std::uint16_t id, const TopTwo& out) {
    std::uint16_t* const __restrict best = out.first.data();
    float* const __restrict best_echo = out.first_echo.data();
    std::uint16_t* const __restrict second = out.second.data();
    float* const __restrict second_echo = out.second_echo.data();
    for (std::size_t i = 0; i < echo.size(); ++i) {
        const float e = echo[i];
        const bool first = e > best_echo[i];
        const bool next = e > second_echo[i];
        const float lower = next ? e : second_echo[i];
        const std::uint16_t lower_id = next ? id : second[i];
        second_echo[i] = first ? best_echo[i] : lower;
        second[i] = first ? best[i] : lower_id;
        best_echo[i] = first ? e : best_echo[i];
        best[i] = first ? id : best[i];
    }
}

/// The same for the largest alone.
void take_largest(std::span<const float> echo, std::uint16_t id, std::uint16_t* __restrict best,
                  float* __restrict best_echo) {
    for (std::size_t i = 0; i < echo.size(); ++i) {
        const bool first = echo[i] > best_echo[i];
        best_echo[i] = first ? echo[i] : best_echo[i];
        best[i] = first ? id : best[i];
    }
}

}  // namespace

TopTwoFinder::TopTwoFinder(std::vector<KeyedSource> sources) : sources_(std::move(sources)) {
    std::ranges::stable_sort(sources_, {}, &KeyedSource::key);
}

void TopTwoFinder::find(const EchoSums& sums, int beam, const TopTwo& out) {
    const std::size_t bins = out.first.size();
    std::span<float> first_echo = out.first_echo;
    if (first_echo.empty()) {
        first_echo_.assign(bins, 0.0F);
        first_echo = first_echo_;
    }
    echo_.assign(bins, 0.0F);
    bool has_echo = false;
    for (std::size_t k = 0; k < sources_.size(); ++k) {
        const auto [key, source] = sources_[k];
        has_echo |= sums.add_to(source, beam, echo_);
        if (!has_echo || (k + 1 < sources_.size() && sources_[k + 1].key == key)) continue;
        const auto id = static_cast<std::uint16_t>(key + 1);
        if (out.second.empty())
            take_largest(echo_, id, out.first.data(), first_echo.data());
        else
            keep_top_two(echo_, id, out);
        std::ranges::fill(echo_, 0.0F);
        has_echo = false;
    }
}

}  // namespace sonarsim
