#include "run/job/ping_cost.h"

#include <variant>

#include "core/clock.h"
#include "core/file.h"
#include "output/dataset/encode_ping.h"
#include "simulate/assembly/assemble.h"
#include "simulate/assembly/poses.h"

namespace sonarsim {

namespace {

// Pings measured after the first: those of records are small, and made into pictures of many.
constexpr std::size_t measured_images = 2;
constexpr std::size_t measured_records = 8;

/// The bytes of some pings by a writer.
using Records = std::vector<std::string>;

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

double ratio(std::size_t a, std::size_t b) {
    return static_cast<double>(a) / static_cast<double>(b);
}

/// The bytes of the products of all pings of a sonar: made in a temporary folder of some pings with
/// these records in turn. `all`: the writers of all pings. `records`: by writer and ping.
double product_bytes(const WriterContext& context, const Writers& all,
                     const std::vector<Records>& records) {
    if (std::ranges::none_of(all, [](const Writer& one) { return bool(one.write_products); }))
        return 0.0;
    constexpr std::size_t max_pings = 512;
    const WriterContext some{context.mission, context.assembly, context.sensor,
                             std::min(context.pings, max_pings)};
    const Writers writers = make_writers(some);
    const ScratchFolder folder;
    std::vector<std::unique_ptr<RecordFile>> files(writers.size());
    double bytes = 0.0;
    for (std::size_t k = 0; k < writers.size(); ++k) {
        const auto* record = std::get_if<PingRecord>(&writers[k].per_ping);
        if (record == nullptr) continue;
        files[k] =
            std::make_unique<RecordFile>(folder.path() / record->file, record->format, some.pings);
        for (std::size_t ping = 0; ping < some.pings; ++ping)
            files[k]->write(ping, std::as_bytes(std::span(records[k][ping % records[k].size()])));
    }
    for (std::size_t k = 0; k < writers.size(); ++k) {
        if (!writers[k].write_products) continue;
        writers[k].write_products(*files[k], folder.path());
        // A sweep has files of its own; other files grow with the pings.
        const std::size_t made = writers[k].products.size();
        const double times = all[k].products.size() > made ? ratio(all[k].products.size(), made)
                                                           : ratio(context.pings, some.pings);
        for (const std::string& name : writers[k].products)
            bytes += times * static_cast<double>(std::filesystem::file_size(folder.path() / name));
    }
    return bytes;
}

}  // namespace

std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const Layout& layout, double& set_up_s) {
    Stopwatch watch;
    const std::unique_ptr<VisibilityEngine> engine = make_engine(mission, assembly);
    set_up_s += watch.lap();
    std::vector<PingCost> costs(assembly.sonars.size());
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
        const Sonar& sonar = assembly.sonars[i];
        const Writers& writers = layout.sensors[i].writers;
        const LabelPlan plan = plan_labels(mission, assembly, sonar);
        const std::size_t max_pings =
            kind_of(sonar.config.kind).has_images ? measured_images : measured_records;
        const std::vector<std::uint32_t> poses =
            sample_pings(assembly.trajectory.size(), sonar.config.every, max_pings);
        std::vector<Records> records(writers.size());
        const auto measure = [&](std::uint32_t pose) {
            watch.lap();
            WrittenPing written = encode_ping(
                assembly, writers, plan, render_at_pose(mission, assembly, *engine, {pose, i}));
            const PingCost cost{watch.lap(), bytes_of_ping(writers, written.parts)};
            for (std::size_t k = 0; k < records.size(); ++k)
                records[k].push_back(std::move(written.parts[k]));
            return cost;
        };
        const double first_s = measure(poses.front()).seconds;
        std::ranges::for_each(records, [](Records& all) { all.clear(); });
        for (const std::uint32_t pose : poses) {
            const PingCost cost = measure(pose);
            costs[i].seconds += cost.seconds / static_cast<double>(poses.size());
            costs[i].bytes += cost.bytes / static_cast<double>(poses.size());
        }
        const std::size_t pings = layout.sensors[i].pings;
        costs[i].bytes += product_bytes({mission, assembly, i, pings}, writers, records) /
                          static_cast<double>(pings);
        set_up_s += std::max(0.0, first_s - costs[i].seconds);
    }
    return costs;
}

}  // namespace sonarsim
