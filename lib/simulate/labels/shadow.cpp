#include "simulate/labels/shadow.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// Replaces each 0 by the nearest other value, in a tie by the one before. False: all are 0.
bool fill_gaps(std::span<std::uint16_t> ids) {
    const auto count = static_cast<int>(ids.size());
    int before = -1;
    for (int i = 0; i <= count; ++i) {
        if (i < count && ids[i] == 0) continue;
        if (i == count && before < 0) return false;
        for (int k = before + 1; k < i; ++k) {
            const bool lower = before >= 0 && (i == count || k - before <= i - k);
            ids[k] = ids[lower ? before : i];
        }
        before = i;
    }
    return true;
}

bool has_dark_bins(std::span<const std::uint8_t> covered, std::span<const std::uint8_t> occupied) {
    std::uint8_t dark = 0;  // no bool, so that the loop vectorises
    for (std::size_t i = 0; i < covered.size(); ++i)
        dark |= covered[i] > occupied[i] ? std::uint8_t{1} : std::uint8_t{0};
    return dark != 0;
}

/// Gives the bins in shadow their owners. False: some have none. The loop vectorises.
bool name_dark_bins(std::span<const std::uint8_t> covered, std::span<const std::uint8_t> occupied,
                    std::span<const std::uint16_t> owners, std::span<std::uint16_t> shadow) {
    std::uint16_t without = 0;
    std::uint16_t* const __restrict out = shadow.data();
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const std::uint16_t dark = covered[i] > occupied[i] ? 0xFFFF : 0;
        out[i] = owners[i] & dark;
        without |= owners[i] == 0 ? dark : std::uint16_t{0};
    }
    return without == 0;
}

EchoSums sums_of(std::span<const HiddenPiece> pieces, const View& view) {
    EchoSums sums(range_bins(view), view.beams);
    EchoBlock block;
    block.intensity.fill(1.0F);
    std::array<std::uint32_t, EchoBlock::capacity> objects;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const int at = block.count++;
        const HiddenPiece& hidden = pieces[k];
        block.range_m[at] = hidden.range_m;
        block.half_m[at] = hidden.half_m;
        block.weight[at] = hidden.solid_angle;
        block.beam[at] = hidden.beam;
        objects[at] = hidden.object;
        if (block.count < EchoBlock::capacity && k + 1 < pieces.size()) continue;
        sums.add(block, objects);
        block.count = 0;
    }
    return sums;
}

std::vector<KeyedSource> sources_of(const EchoSums& sums) {
    std::vector<KeyedSource> sources;
    for (std::uint32_t k = 0; k < sums.sources(); ++k)
        sources.push_back({k, k});
    return sources;
}

}  // namespace

ShadowFinder::ShadowFinder(std::span<const HiddenPiece> pieces, const View& view)
    : range_bins_(static_cast<std::size_t>(view.range_bins)),
      sums_(sums_of(pieces, view)),
      finder_(sources_of(sums_)),
      owners_(view.beams) {}

std::vector<std::uint16_t>& ShadowFinder::owners(int j) {
    std::vector<std::uint16_t>& owners = owners_[j];
    if (owners.empty()) {
        owners.resize(range_bins_);
        finder_.find(sums_, j, {owners, {}});
    }
    return owners;
}

void ShadowFinder::find(int j, std::span<const std::uint8_t> covered,
                        std::span<const std::uint8_t> occupied, std::span<std::uint16_t> shadow) {
    std::ranges::fill(shadow, 0);
    if (sums_.sources() == 0 || !has_dark_bins(covered, occupied)) return;
    // The nearest owners are needed only where no line ends in a dark bin.
    if (!name_dark_bins(covered, occupied, owners(j), shadow) && fill_gaps(owners(j)))
        name_dark_bins(covered, occupied, owners(j), shadow);
}

std::vector<std::uint8_t> bins_above_shadow(const EchoSums& sums, int beam,
                                            std::span<const std::uint32_t> ground,
                                            std::span<const std::uint8_t> hidden) {
    constexpr std::ptrdiff_t nearest = 16;
    constexpr double shadow_below = 0.1;
    const std::span<const std::uint8_t> occupied = sums.occupied(beam);
    std::vector<std::uint8_t> out(occupied.begin(), occupied.end());
    std::vector<float> echoes(hidden.size());
    std::vector<float> levels(hidden.size());
    for (std::uint32_t source = 0; source < sums.sources(); ++source)
        sums.add_to(source, beam, echoes);
    for (const std::uint32_t source : ground)
        sums.add_to(source, beam, levels);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (hidden[i] == 0 && levels[i] > 0.0F) open.push_back(i);
    }
    // The middle of the open bins [from, to), and the logarithm of their median.
    const auto level = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
        std::vector<float> values;
        for (std::ptrdiff_t k = from; k < to; ++k)
            values.push_back(levels[open[static_cast<std::size_t>(k)]]);
        const auto middle = values.begin() + (to - from) / 2;
        std::nth_element(values.begin(), middle, values.end());
        return std::pair(static_cast<double>(open[static_cast<std::size_t>(from + to) / 2]),
                         logarithm(static_cast<double>(*middle)));
    };
    const std::ptrdiff_t count = std::ssize(open);
    std::ptrdiff_t next = -1;  // the first open bin behind bin i
    std::pair<double, double> near, far;
    for (std::size_t i = 0; i < out.size() && count > 0; ++i) {
        if (occupied[i] == 0 || hidden[i] == 0) continue;
        const std::ptrdiff_t at = std::ranges::lower_bound(open, i) - open.begin();
        if (at != next) {
            far = at < count ? level(at, std::min(at + nearest, count)) : far;
            near = at > 0 ? level(std::max<std::ptrdiff_t>(at - nearest, 0), at) : far;
            if (at == count) far = near;
            next = at;
        }
        const double share =
            far.first > near.first
                ? std::clamp((static_cast<double>(i) - near.first) / (far.first - near.first), 0.0,
                             1.0)
                : 0.0;
        const double ground_level = exponential(near.second + share * (far.second - near.second));
        out[i] = static_cast<double>(echoes[i]) >= shadow_below * ground_level ? 1 : 0;
    }
    return out;
}

}  // namespace sonarsim
