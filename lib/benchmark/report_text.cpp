#include "benchmark/report_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace sonarsim {

namespace {

/// Three significant digits, without an exponent.
std::string short_number(double x) {
    if (!(x >= 5e-5)) return "0";
    const int digits = 2 - static_cast<int>(std::floor(std::log10(x)));
    return fmt::format("{:.{}f}", x, std::clamp(digits, 0, 4));
}

std::string percent(double x) {
    return short_number(100.0 * x) + " %";
}

std::string between(const Summary& spread) {
    return short_number(spread.min) + "-" + short_number(spread.max);
}

std::string label(const ReportRow& row) {
    return row.setting.engine + " " + row.setting.name;
}

/// The best of the rows that `counts` accepts, by the rule of explain_auto.
const ReportRow* best(const Report& report, const std::string& sensor,
                      const std::function<bool(const ReportRow&)>& counts) {
    const ReportRow* found = nullptr;
    for (const ReportRow& row : report.rows) {
        if (row.sensor != sensor || !counts(row)) continue;
        const bool meets = row.relative_l1.centre <= report.goal;
        const bool found_meets = found != nullptr && found->relative_l1.centre <= report.goal;
        const bool better = found == nullptr       ? true
                            : meets != found_meets ? meets
                            : meets ? row.ms_per_ping.centre < found->ms_per_ping.centre
                                    : row.relative_l1.centre < found->relative_l1.centre;
        if (better) found = &row;
    }
    return found;
}

std::string costs(const Report& report, const std::string& sensor) {
    std::string text = fmt::format(
        "{:<28}{:>9}{:>17}{:>8}{:>9}{:>9}{:>10}{:>8}{:>9}{:>9}{:>9}{:>10}{:>8}{:>8}{:>8}\n", sensor,
        "ms/ping", "(over poses)", "x rays", "pings/s", "L1", "worst L1", "goal", "L2", "miss",
        "false", "samples", "build s", "first s", "MiB");
    for (const ReportRow& row : report.rows) {
        if (row.sensor != sensor) continue;
        text += fmt::format(
            "{:<28}{:>9}{:>17}{:>8}{:>9.0f}{:>9}{:>10}{:>8}{:>9}{:>9}{:>9}{:>10.0f}{:>8.2f}{:>8.2f}"
            "{:>8.0f}\n",
            fmt::format("{}{} {}", row.on_front ? "*" : " ", label(row),
                        row.setting.current ? "<" : ""),
            short_number(row.ms_per_ping.centre), between(row.ms_per_ping),
            short_number(row.times_rays), row.pings_per_s, percent(row.relative_l1.centre),
            percent(row.relative_l1.max), row.promise(), percent(row.relative_l2.centre),
            percent(row.miss_rate.centre), percent(row.false_rate.centre),
            row.samples_per_ping.centre, row.cold.build_s, row.cold.first_ping_s,
            row.cold.peak_memory_mb);
    }
    return text;
}

std::string stages(const Report& report, const std::string& sensor) {
    std::string text = fmt::format("{:<28}", "stages, ms");
    for (const auto& timer : ping_timers)
        text += fmt::format("{:>12}", timer.name);
    text += fmt::format("{:>14}{:>12}{:>12}{:>14}\n", "bare Embree", "x of bare", "131k rays",
                        "slowest ping");
    for (const ReportRow& row : report.rows) {
        if (row.sensor != sensor) continue;
        text += fmt::format("{:<28}", " " + label(row));
        for (const auto& timer : ping_timers)
            text += fmt::format("{:>12}", short_number(1e3 * row.stages.*timer.member));
        text += fmt::format(
            "{:>14}{:>12}{:>12}{:>14}\n", short_number(row.ms_bare),
            row.ms_bare > 0.0 ? short_number(row.ms_per_ping.centre / row.ms_bare) : "-",
            short_number(row.ms_rays), short_number(row.cold.slowest_ms));
    }
    return text;
}

/// Compares the mission's own setting with bare Embree, and names the slowest stage.
std::string embree_comparison(const Report& report, const std::string& sensor) {
    for (const ReportRow& row : report.rows) {
        double sum = 0.0;
        for (const auto& timer : ping_timers)
            sum += row.stages.*timer.member;
        if (row.sensor != sensor || !row.setting.current || !(sum > 0.0 && row.ms_bare > 0.0)) {
            continue;
        }
        std::string shares;
        for (const auto& timer : ping_timers) {
            shares += fmt::format("{}{:.0f} % {}", shares.empty() ? "" : ", ",
                                  100.0 * row.stages.*timer.member / sum, timer.name);
        }
        const auto most = std::ranges::max_element(
            ping_timers, {}, [&](const auto& timer) { return row.stages.*timer.member; });
        return fmt::format(
            "{}: a ping takes {} times as long as bare Embree with as many rays: {}. The stage {} "
            "takes most.\n",
            label(row), short_number(row.ms_per_ping.centre / row.ms_bare), shares, most->name);
    }
    return "";
}

std::string figures(const ReportRow& row) {
    return fmt::format("{} ({} in {} ms)", label(row), percent(row.relative_l1.centre),
                       short_number(row.ms_per_ping.centre));
}

std::string label(const MultipathRow& row) {
    const MultipathConfig& setting = row.setting;
    if (setting.method == MultipathMethod::exact) return "exact";
    return fmt::format("cluster epsilon={} delta={}", setting.epsilon_bins, setting.delta_deg);
}

/// Compares the multipath methods with the exact one; empty for a sonar without multipath.
std::string multipath(const Report& report, const std::string& sensor) {
    std::string text;
    for (const MultipathRow& row : report.multipath) {
        if (row.sensor != sensor) continue;
        if (text.empty()) {
            text = fmt::format("\n{:<28}{:>9}{:>9}{:>11}{:>11}{:>17}{:>10}{:>10}{:>17}{:>11}\n",
                               "multipath", "L1", "recall", "precision", "stage ms", "(over poses)",
                               "speed-up", "ms/ping", "(over poses)", "x without");
        }
        text += fmt::format("{:<28}{:>9}{:>9}{:>11}{:>11}{:>17}{:>10}{:>10}{:>17}{:>11.2f}\n",
                            fmt::format(" {} {}", label(row), row.current ? "<" : ""),
                            percent(row.relative_l1), percent(row.recall), percent(row.precision),
                            short_number(row.ms_multipath.centre), between(row.ms_multipath),
                            short_number(row.speed_up), short_number(row.ms_per_ping.centre),
                            between(row.ms_per_ping), row.times_without());
    }
    if (text.empty()) return text;
    const MultipathRow& any = *std::ranges::find(report.multipath, sensor, &MultipathRow::sensor);
    return text +
           fmt::format(
               "Errors are those of the multipath echoes only, relative to the exact method, "
               "which fills {} bins at {} poses;\nwithout multipath a ping takes {} ms.\n",
               any.exact_bins, report.poses, short_number(any.ms_without));
}

std::string labels(const Report& report, const std::string& sensor) {
    std::string text;
    for (const LabelRow& row : report.labels) {
        if (row.sensor != sensor) continue;
        if (text.empty())
            text = fmt::format("\n{:<28}{:>9}{:>11}{:>17}\n", "labels", "ms", "x ping",
                               "(over poses)");
        text += fmt::format("{:<28}{:>9}{:>11.2f}{:>17}\n", " " + row.label,
                            short_number(row.ms.centre), row.times_ping.centre,
                            between(row.times_ping));
    }
    return text;
}

std::string growth_text(const Report& report) {
    std::string text;
    for (const Growth& growth : report.growth) {
        text += fmt::format("{} {}, growing in {}: ms per ping ~ triangles^{:.2f};", growth.sensor,
                            growth.engine, growth.along, growth.exponent);
        for (std::size_t i = 0; i < growth.triangles.size(); ++i) {
            text += fmt::format(" {:.0f}: {}", growth.triangles[i],
                                short_number(growth.ms_per_ping[i]));
        }
        text += "\n";
    }
    return text;
}

std::string labels_markdown(const Report& report) {
    if (report.labels.empty()) return "";
    std::string text =
        "\n| sonar | label | ms | times the ping | over the poses |\n|---|---|---|---|---|\n";
    for (const LabelRow& row : report.labels) {
        text += fmt::format("| {} | {} | {} | {:.2f} | {} |\n", row.sensor, row.label,
                            short_number(row.ms.centre), row.times_ping.centre,
                            between(row.times_ping));
    }
    return text;
}

}  // namespace

std::string explain_auto(const Report& report, const std::string& sensor) {
    const auto best_of = [&](std::initializer_list<std::string_view> engines) {
        return best(report, sensor, [&](const ReportRow& row) {
            return std::ranges::find(engines, row.setting.engine) != engines.end();
        });
    };
    const ReportRow* const rays = best_of({"rays"});
    const ReportRow* const octree = best_of({"octree", "literal"});
    const ReportRow* const slices = best_of({"slices"});
    const ReportRow* const all = best(report, sensor, [](const ReportRow&) { return true; });
    if (all == nullptr || rays == nullptr) return "";
    std::string text = fmt::format(
        "{}: engine: auto takes the slices, or rays where they meet the goal with less than half "
        "of the samples. At the goal of {} the best rays are {}",
        sensor, percent(report.goal), figures(*rays));
    if (octree != nullptr) text += fmt::format(", the best octree is {}", figures(*octree));
    if (slices != nullptr) text += fmt::format(", the best slices are {}", figures(*slices));
    text += ".";
    if (all == octree) {
        text += fmt::format(" Here the octree is better: set engine: octree and octree.{}.",
                            octree->setting.name);
    }
    return text;
}

std::string report_text(const Report& report) {
    std::string text = fmt::format("{}: {} triangles, {} poses, {} threads\n", report.mission,
                                   report.triangles, report.poses, report.threads);
    if (report.load > 0.5) {
        text += fmt::format(
            "The machine was busy (load {:.1f}) before this began: times are too "
            "long.\n",
            report.load);
    }
    for (const ReferenceQuality& reference : report.references) {
        text += "\n" + costs(report, reference.sensor) + "\n" + stages(report, reference.sensor);
        text += fmt::format(
            "reference: {:.0f} rays per bin, settled to {}, at most {}; its two starts lie within "
            "{}, "
            "at most {}\n",
            reference.rays_per_bin.centre, percent(reference.moved.centre),
            percent(reference.moved.max), percent(reference.apart.centre),
            percent(reference.apart.max));
        text += embree_comparison(report, reference.sensor) +
                explain_auto(report, reference.sensor) + "\n" +
                multipath(report, reference.sensor) + labels(report, reference.sensor);
    }
    return text + growth_text(report) +
           "* no setting is both faster and more accurate; < the mission's own setting. ms/ping on "
           "one thread,\npings/s on all, noise on; x rays: multiple of Embree's time for 131,072 "
           "rays over the view. Errors are\nthose of the direct echoes without noise, mean and "
           "worst over the poses; goal: whether the worst met it,\nor the engine warned, or missed "
           "it. MiB is the peak of a process with this setting alone.\n";
}

std::string report_markdown(const Report& report) {
    std::string text =
        "| engine | setting | ms per ping | x 131k rays | pings/s | relative L1 | worst pose | "
        "goal "
        "| missed bins | false bins | samples | first ping, s | peak, MiB |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const ReportRow& row : report.rows) {
        const char* const bold = row.on_front ? "**" : "";
        text += fmt::format(
            "| {} | {} | {}{}{} | {} | {:.0f} | {}{}{} | {} | {} | {} | {} | {:.0f} | {:.2f} | "
            "{:.0f} |\n",
            row.setting.engine, row.setting.name, bold, short_number(row.ms_per_ping.centre), bold,
            short_number(row.times_rays), row.pings_per_s, bold, percent(row.relative_l1.centre),
            bold, percent(row.relative_l1.max), row.promise(), percent(row.miss_rate.centre),
            percent(row.false_rate.centre), row.samples_per_ping.centre, row.cold.first_ping_s,
            row.cold.peak_memory_mb);
    }
    return text + labels_markdown(report);
}

}  // namespace sonarsim
