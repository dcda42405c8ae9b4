#include <algorithm>

#include "calibrated/form_look.h"
#include "calibrated/receiver_chain.h"
#include "core/clock.h"

namespace sonarsim {

namespace {

/// Averages the powers of several looks, and makes one range bin of several samples. The counts are
/// those of the first look.
void form_looks(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
                Ping& ping) {
    const ReceiverConfig& receiver = model.instrument.receiver;
    // Without random draws all looks are the same.
    const int looks = context.terms.random > 0 ? receiver.looks : 1;
    std::vector<float> sum(ping.intensity.size() * receiver.samples);
    for (int look = 0; look < looks; ++look) {
        Ping of_look = ping;
        of_look.intensity.assign(sum.size(), 0.0F);
        FormContext with_draws = context;
        with_draws.draws.look = static_cast<std::uint32_t>(look);
        form_look(model, traced, with_draws, of_look);
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += of_look.intensity[k] / static_cast<float>(looks);
        if (look == 0) std::swap(ping.counts, of_look.counts);
    }
    combine_samples(sum, receiver.samples, receiver.combine, context.view.beams, ping.intensity);
}

}  // namespace

void CalibratedModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    if (!is_prepared_for(context.scene))
        return prepared_for(context.scene)->form(traced, context, ping);
    Stopwatch watch;
    const ReceiverConfig& receiver = instrument.receiver;
    if (receiver.samples == 1 && receiver.looks == 1)
        form_look(*this, traced, context, ping);
    else
        form_looks(*this, traced, context, ping);
    const ImageRows rows{.range_min_m = context.view.range_min_m,
                         .bin_m = context.view.bin_m(),
                         .rows = context.view.range_bins,
                         .beams = context.view.beams,
                         .noise = noise_values};
    // Faults belong to the receiver's noise, the last of the random terms.
    if (context.terms.random > 1 && has_faults(receiver))
        add_faults(receiver, rows, context.draws, ping.intensity);
    ping.seconds.accumulate = watch.lap();
}

}  // namespace sonarsim
