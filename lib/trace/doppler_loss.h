#pragma once

namespace sonarsim {

/// The loss of the matched filter for the echo of a place that recedes at the speed w. The echo's
/// frequency f is shifted by 2 f w / c.
struct DopplerLoss {
    /// A tone of length T: 2 f T / c, the turns of phase over the pulse by speed. 0: no tone.
    double turns_s_per_m = 0.0;
    /// A pulse that sweeps over the band B: 2 f / (c B), the share of the band by speed. 0: none.
    double band_s_per_m = 0.0;

    bool is_none() const { return turns_s_per_m == 0.0 && band_s_per_m == 0.0; }
};

/// The share of the power that the filter passes. The filter of a tone sums the echo over T with
/// the phases of the transmitted pulse: sinc^2 of the turns. A sweep matches the filter at a
/// shifted range, except for the share a of the band at its ends: (1 - a)^2. Both are the pulse's
/// ambiguity function, for even amplitudes.
double passed_by_filter(const DopplerLoss& loss, double recedes_m_s);

}  // namespace sonarsim
