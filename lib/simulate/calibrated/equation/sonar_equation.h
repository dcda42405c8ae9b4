#pragma once

#include "input/mission/instrument.h"
#include "input/scene/scene.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/equation/patches.h"
#include "simulate/calibrated/signal/echo_grid.h"

namespace sonarsim {

struct SineTable {
    static constexpr int steps = 2048;
    float from = 0.0F;          ///< the sine of the first entry
    float per_unit = 0.0F;      ///< entries per unit of sine
    std::vector<float> values;  ///< steps + 2; empty: 1 all over

    float at(float sine) const;
};

template <class Function>
SineTable sine_table(double from, double to, const Function& value) {
    SineTable out{.from = static_cast<float>(from),
                  .per_unit = static_cast<float>(SineTable::steps / (to - from)),
                  .values = {}};
    for (int k = 0; k <= SineTable::steps + 1; ++k)
        out.values.push_back(static_cast<float>(value(from + (to - from) * k / SineTable::steps)));
    return out;
}

/// The power of a two-way pattern by the sine of the elevation: that of a line array of half-power
/// width `width_rad`, as if only the transmitter had one; 0: omnidirectional. Adds `floor_db`.
SineTable elevation_pattern(double width_rad, double side_lobe_db,
                            const ElementsConfig& elements = {},
                            double floor_db = no_lobe_floor_db);

/// The echo of a piece of surface, and its range bin:
///
///     EL = SL + S(grazing angle) + 10 log A + D(elevation) - 40 log r - 2 alpha r    dB
///
/// as a ratio to the source level, so that SL is 0 here.
struct SonarEquation {
    float range_min_m = 0.0F;
    float bin_m = 0.0F;
    int rows = 0;
    float loss_per_m = 0.0F;   ///< two-way absorption: power falls as e^-(loss r)
    float ln_headroom = 0.0F;  ///< powers are e^ln_headroom times their ratio to the source level
    SineTable elevation;
};

struct PointEchoes {
    int count = 0;  ///< pieces, rounded up to whole vectors; echoes beyond have no power
    PatchBlock::Array<float> range_m;
    PatchBlock::Array<float> power;
    PatchBlock::Array<float> row;     ///< in bins from the middle of the first one, -1 to rows
    PatchBlock::Array<float> column;  ///< column of the grid, if beams are formed
};

/// One end of the specular paths: the sound departs towards it or arrives from it.
struct PathEndpoint {
    const PatchBlock& places;
    const PointEchoes& echoes;
};

/// Complex numbers, one for each piece of a block.
struct Amplitudes {
    PatchBlock::Array<float> re, im;
};

/// Multiplies the powers of the first `count` pieces by the pattern towards them, at `range_m`.
void weigh_by_elevation(const SineTable& pattern, const PatchBlock& pieces, int count,
                        PointEchoes& echoes);

/// Fills `echoes` but for the columns. Echoes outside the range have power 0; returns their number.
std::uint64_t apply_sonar_equation(const PatchBlock& pieces, const Scattering& scattering,
                                   const SonarEquation& equation, PointEchoes& echoes);

}  // namespace sonarsim
