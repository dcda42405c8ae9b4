#include "labels/shadow.h"

#include <algorithm>

namespace sonarsim {

namespace {

/// Replaces each 0 by the nearest other value; at equal distance by the lower one. False: all are
/// 0.
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

/// Gives the bins in shadow their owners. False: some have none. No branches, so that the loop
/// vectorises.
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

}  // namespace

ShadowFinder::ShadowFinder(std::span<const HiddenPiece> pieces, const View& view)
    : bins_(range_bins(view)),
      full_turn_(is_full_turn(view)),
      pieces_(pieces),
      beam_begin_(view.beams + 1, 0),
      owners_(view.beams) {
    for (const HiddenPiece& hidden : pieces_)
        ++beam_begin_[hidden.beam + 1];
    for (int j = 0; j < view.beams; ++j)
        beam_begin_[j + 1] += beam_begin_[j];
    std::vector<std::uint32_t> next = beam_begin_;
    places_.resize(pieces_.size());
    for (std::uint32_t k = 0; k < pieces_.size(); ++k)
        places_[next[pieces_[k].beam]++] = {pieces_[k].object, k};
}

std::vector<std::uint16_t>& ShadowFinder::owners(int j) {
    std::vector<std::uint16_t>& owners = owners_[j];
    if (owners.empty()) {
        owners.resize(bins_.count);
        find_owners(j, owners);
    }
    return owners;
}

void ShadowFinder::find_owners(int j, std::span<std::uint16_t> owners) {
    const auto own =
        std::span(places_).subspan(beam_begin_[j], beam_begin_[j + 1] - beam_begin_[j]);
    if (own.empty()) return;
    std::ranges::sort(own);
    shares_.clear(bins_.count);
    for (std::size_t a = 0, b = 0; a < own.size(); a = b) {
        while (b < own.size() && own[b].object == own[a].object)
            ++b;
        echoes_.resize(b - a);
        for (std::size_t k = a; k < b; ++k) {
            const HiddenPiece& hidden = pieces_[own[k].at];
            echoes_.range_m[k - a] = hidden.range_m;
            echoes_.half_m[k - a] = hidden.half_m;
            echoes_.weight[k - a] = hidden.solid_angle;
            echoes_.intensity[k - a] = 1.0F;
        }
        const EchoRange all{0, static_cast<std::uint32_t>(echoes_.size())};
        shares_.add(own[a].object, echoes_, {&all, 1}, bins_);
    }
    finder_.find(
        shares_, Ranks::first, [](std::uint32_t object) { return object; }, strongest_);
    for (int i = strongest_.first; i < strongest_.last; ++i)
        owners[i] = static_cast<std::uint16_t>(strongest_.key[i]);
}

std::span<const std::uint16_t> ShadowFinder::nearest_owners(int j) {
    const auto beams = static_cast<int>(owners_.size());
    for (int away = 0; away < beams; ++away) {
        for (int beam : {j - away, j + away}) {
            if (full_turn_) beam = (beam + beams) % beams;
            if (beam < 0 || beam >= beams) continue;
            if (fill_gaps(owners(beam))) return owners(beam);
        }
    }
    return owners(j);
}

void ShadowFinder::find(int j, std::span<const std::uint8_t> covered,
                        std::span<const std::uint8_t> occupied, std::span<std::uint16_t> shadow) {
    std::ranges::fill(shadow, 0);
    if (pieces_.empty() || !has_dark_bins(covered, occupied)) return;
    // The nearest owners are needed only where no line ends in a dark bin.
    if (!name_dark_bins(covered, occupied, owners(j), shadow))
        name_dark_bins(covered, occupied, nearest_owners(j), shadow);
}

}  // namespace sonarsim
