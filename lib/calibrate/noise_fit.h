#pragma once

#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/law_fit.h"
#include "recording/recording.h"

namespace sonarsim {

/// The level of the noise in a block of bins, all beams and pings together.
struct NoiseBlock {
    int row = 0;  ///< the first
    double range_m = 0.0;
    double level_db = 0.0;       ///< re full scale
    bool homogeneous = false;    ///< beams and pings have one level, and no value is 0
    bool without_echo = false;   ///< no part is constant from ping to ping, so it has no echo
    bool without_zeros = false;  ///< hardly a value is 0
};

inline constexpr int rows_of_noise_block = 8;

/// The beams about straight ahead that have the noise which all elements share, from `first` to
/// before `end`.
struct AheadBeams {
    int first = 0, end = 0;

    bool holds(int beam) const { return first <= beam && beam < end; }
};

/// The level of the part that changes from ping to ping, by range. Noise N is new in every ping; an
/// echo of a scene at rest is constant. With M the mean of the powers A and B of a place in two
/// pings, the mean of (A - B)^2 is 2 (2 M N - N^2), for one look at one sample. If pings are
/// independent, N is M. The beams `ahead` do not count.
std::vector<NoiseBlock> noise_blocks(const Recording& recording, const LawFit& law,
                                     const AheadBeams& ahead = {});

/// The noise after the gain: level_db + tvg_log log10(r) + 2 absorption r, r at least tvg_from_m.
struct NoiseFit {
    Bounded level_db;  ///< noise less full scale, extrapolated to 1 m without absorption
    Bounded tvg_log;
    Bounded tvg_from_m;            ///< 0 if the pings do not determine it
    std::vector<NoiseBlock> used;  ///< the blocks that lie on it
    Bounded common_mode_db;        ///< re the noise of a beam; value below -50: none seen
    AheadBeams ahead;              ///< the beams that do not count
    double absorption_db_per_m = 0.0;

    double at(double range_m) const;
};

/// The lowest law of this form on which many blocks lie, since echoes only add to noise. Nothing
/// when no such law holds at least 6 blocks and an eighth of all.
std::optional<NoiseFit> fit_noise(const std::vector<NoiseBlock>& blocks,
                                  double absorption_db_per_m);

}  // namespace sonarsim
