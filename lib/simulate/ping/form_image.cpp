#include "simulate/ping/form_image.h"

namespace sonarsim {

namespace {

Ping form_group(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms) {
    Ping ping;
    ping.range_bins = settings.view.range_bins;
    ping.beams = settings.view.beams;
    ping.intensity.resize(static_cast<std::size_t>(ping.range_bins) * ping.beams);
    ping.counts = traced.counts;
    ping.seconds = traced.seconds;
    if (!terms.multipath) ping.counts.multipath = {};
    settings.model->form(traced,
                         {.view = settings.view,
                          .scene = scene,
                          .draws = {.seed = key.seed, .sensor = settings.stream, .ping = key.ping},
                          .terms = terms},
                         ping);
    return ping;
}

}  // namespace

Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms) {
    Ping ping = form_group(traced, settings, scene, key, terms);
    for (int group = 1; group < traced.groups(); ++group) {
        const Ping later = form_group(traced.group(group), settings, scene, key, terms);
        for (std::size_t at = 0; at < ping.intensity.size(); ++at) {
            if (traced.transmits(group,
                                 static_cast<int>(at % static_cast<std::size_t>(ping.beams))))
                ping.intensity[at] = later.intensity[at];
        }
        ping.counts += later.counts;
        ping.seconds += later.seconds;
    }
    // Each group is traced with all beams and gives its own to the image.
    divide(ping.counts, static_cast<std::size_t>(traced.groups()));
    return ping;
}

}  // namespace sonarsim
