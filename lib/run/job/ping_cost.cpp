#include "run/job/ping_cost.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "core/clock.h"
#include "output/dataset/encode_ping.h"
#include "simulate/assembly/engines.h"
#include "simulate/assembly/sample_pings.h"

namespace sonarsim {

namespace {

// Pings that are measured, after the first. The ping of a sonar without images is small, and its
// products are pictures of many pings.
constexpr std::size_t measured_images = 2;
constexpr std::size_t measured_records = 8;

/// The bytes of a ping in its own files and records, in journal.txt and in SHA256SUMS.
double bytes_of_ping(const Writers& writers, const std::vector<std::string>& parts) {
    constexpr double line = 25.0;  // in the journal, without its fields
    constexpr double record_field = 17.0;
    constexpr double file_fields = 160.0;  // in the journal and in SHA256SUMS
    double bytes = line;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const bool is_file = std::holds_alternative<PingFile>(writers[k].per_ping);
        bytes += static_cast<double>(parts[k].size()) + (is_file ? file_fields : record_field);
    }
    return bytes;
}

}  // namespace

std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const std::vector<Writers>& writers, double& set_up_s) {
    Stopwatch watch;
    const std::unique_ptr<VisibilityEngine> engine = make_engine(mission, assembly);
    set_up_s += watch.lap();
    std::vector<PingCost> costs(assembly.sonars.size());
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
        const Sonar& sonar = assembly.sonars[i];
        const LabelPlan plan = plan_labels(mission, assembly, sonar);
        const std::size_t max_pings =
            kind_of(sonar.config.kind).has_images ? measured_images : measured_records;
        const std::vector<std::uint32_t> poses =
            sample_pings(assembly.trajectory.size(), sonar.config.every, max_pings);
        std::vector<std::vector<SampleRecord>> samples(writers[i].size());
        const auto measure = [&](std::uint32_t pose) {
            watch.lap();
            WrittenPing written = encode_ping(
                assembly, writers[i], plan, render_at_pose(mission, assembly, *engine, {pose, i}));
            const PingCost cost{watch.lap(), bytes_of_ping(writers[i], written.parts)};
            for (std::size_t k = 0; k < samples.size(); ++k)
                samples[k].push_back({pose, std::move(written.parts[k])});
            return cost;
        };
        const double first_s = measure(poses.front()).seconds;
        std::ranges::for_each(samples, [](auto& records) { records.clear(); });
        for (const std::uint32_t pose : poses) {
            const PingCost cost = measure(pose);
            costs[i].seconds += cost.seconds / static_cast<double>(poses.size());
            costs[i].bytes += cost.bytes / static_cast<double>(poses.size());
        }
        const double pings =
            static_cast<double>(count_pings(mission, assembly.trajectory.size())[i]);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            if (writers[i][k].product_bytes)
                costs[i].bytes += writers[i][k].product_bytes(samples[k]) / pings;
        }
        set_up_s += std::max(0.0, first_s - costs[i].seconds);
    }
    return costs;
}

}  // namespace sonarsim
