#include "survey_report.h"

#include <spdlog/fmt/fmt.h>
#include <tbb/info.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/text.h"
#include "logging.h"
#include "simulate/assembly/placed_files.h"

namespace sonarsim {

namespace {

/// Instances with their share of the visible surface, the largest first.
std::vector<std::pair<std::string, double>> max_visible(const SonarSurvey& found,
                                                        const Scene& scene) {
    constexpr std::size_t max_listed = 5;
    const double all = std::reduce(found.visible_m2.begin(), found.visible_m2.end());
    std::vector<std::pair<std::string, double>> visible;
    for (std::size_t i = 0; i < found.visible_m2.size(); ++i) {
        if (found.visible_m2[i] > 0.0)
            visible.emplace_back(scene.instances[i], found.visible_m2[i] / all);
    }
    std::ranges::stable_sort(visible,
                             [](const auto& a, const auto& b) { return a.second > b.second; });
    if (visible.size() > max_listed) visible.resize(max_listed);
    return visible;
}

/// The objects that are no background with the pings that see them, the rarest first.
std::vector<std::pair<std::string, std::size_t>> pings_in_view(const SonarSurvey& found,
                                                               const SceneObjects& objects) {
    std::vector<std::pair<std::string, std::size_t>> all;
    for (std::uint32_t k = 0; k < objects.objects.size(); ++k) {
        if (!objects.is_background(k)) all.emplace_back(objects.objects[k].name, found.visible[k]);
    }
    std::ranges::stable_sort(all, {}, [](const auto& one) { return one.second; });
    return all;
}

/// A line for the objects, "" if there are none.
std::string in_view_text(const SonarSurvey& found, const SceneObjects& objects) {
    constexpr std::size_t max_listed = 12;
    const auto all = pings_in_view(found, objects);
    if (all.empty()) return "";
    std::string text;
    for (std::size_t k = 0; k < std::min(all.size(), max_listed); ++k)
        text += fmt::format("{}{} {}", k == 0 ? "" : ", ", printable(all[k].first), all[k].second);
    if (all.size() > max_listed)
        text +=
            fmt::format(", {} others {} or more", all.size() - max_listed, all[max_listed].second);
    return result_line("", fmt::format("in view in {} pings: {}", found.pings, text));
}

std::string text_of(const ValueRange& interval, const char* unit) {
    if (interval.empty()) return "none";
    return fmt::format("{:.4g} to {:.4g} {}", interval.low, interval.high, unit);
}

Json json_of(const ValueRange& interval) {
    if (interval.empty()) return nullptr;
    return {interval.low, interval.high};
}

std::string size_text(double bytes) {
    constexpr std::array units{"MB", "GB", "TB"};
    double size = 1e-6 * bytes;
    std::size_t unit = 0;
    for (; size >= 1000.0 && unit + 1 < units.size(); ++unit)
        size *= 1e-3;
    return fmt::format("{:.1f} {}", size, units[unit]);
}

}  // namespace

std::string survey_text(const SonarSurvey& found, const Scene& scene, const SceneObjects& objects) {
    const auto line = [](const std::string& text) { return result_line("", text); };
    std::string text = line("altitude " + text_of(found.altitude_m, "m"));
    text += line(fmt::format("{} of {} pings tried are blind, {:.1f} % of the bins are occupied",
                             found.blind, found.pings, 100.0 * found.occupied_share));
    if (found.first_echo_m.empty()) return text;
    text += line(fmt::format("first echo at {}, last at {}", text_of(found.first_echo_m, "m"),
                             text_of(found.last_echo_m, "m")));
    std::string visible;
    for (const auto& [name, share] : max_visible(found, scene)) {
        constexpr double min_share = 0.005;
        if (share < min_share) break;
        visible += fmt::format("{}{} ({:.0f} %)", visible.empty() ? "" : ", ", printable(name),
                               100.0 * share);
    }
    text += line("sees most of " + visible);
    text += in_view_text(found, objects);
    return text +
           line(fmt::format("signal {:.3g}, noise {:.3g}, {:.1f} % of the occupied bins white",
                            found.signal, found.noise, 100.0 * found.white_share));
}

std::string readings_text(const SceneConfig& scene) {
    constexpr std::size_t max_listed = 5;
    std::vector<std::string> readings = readings_of(scene);
    if (readings.size() > max_listed) {
        readings[max_listed] = fmt::format("and {} files more", readings.size() - max_listed);
        readings.resize(max_listed + 1);
    }
    std::string text;
    for (const std::string& reading : readings)
        text += result_line("read as", reading);
    return text;
}

Json survey_json(const SonarSurvey& found, const Scene& scene, const SceneObjects& objects) {
    Json visible = Json::object();
    for (const auto& [name, share] : max_visible(found, scene))
        visible[name] = share;
    Json in_view = Json::object();
    for (const auto& [name, pings] : pings_in_view(found, objects))
        in_view[name] = pings;
    return {{"pings_tried", found.pings},
            {"blind", found.blind},
            {"altitude_m", json_of(found.altitude_m)},
            {"occupied_share", found.occupied_share},
            {"first_echo_m", json_of(found.first_echo_m)},
            {"last_echo_m", json_of(found.last_echo_m)},
            {"seen_most", visible},
            {"in_view", in_view},
            {"signal", found.signal},
            {"noise", found.noise},
            {"white_share", found.white_share},
            {"brightest", found.brightest}};
}

std::string error_line(const std::optional<MeasuredError>& error, const Scene& scene, double goal) {
    if (!error)
        return scene.sound_profile
                   ? result_line("", "error not measured: water.profile bends the sound")
                   : "";
    const double unknown = error->min_measurable();
    const std::string limit =
        fmt::format("cannot be measured to better than {} %", short_text(100.0 * unknown));
    const std::optional<PingError> worst = error->worst();
    if (!worst) return unknown > 0.0 ? result_line("", "error " + limit) : "";
    const auto is_measured = [](const PingError& ping) { return ping.relative_l1.has_value(); };
    const auto is_unknown = [&](const PingError& ping) {
        return !is_measured(ping) && ping.noise > 0.0;
    };
    const auto measured = std::ranges::count_if(error->pings, is_measured);
    std::string text =
        fmt::format("error {} % on average and {} % at worst in {} pings, goal {} %",
                    short_text(100.0 * *error->mean()), short_text(100.0 * *worst->relative_l1),
                    measured, short_text(100.0 * goal, 4));
    const auto by_finer_image = std::ranges::count_if(error->pings, [&](const PingError& ping) {
        return is_measured(ping) && ping.by_finer_image;
    });
    if (by_finer_image > 0)
        text += fmt::format("; {} by the change to a finer goal", by_finer_image);
    if (unknown > 0.0)
        text += fmt::format("; in {} more it {}", std::ranges::count_if(error->pings, is_unknown),
                            limit);
    return result_line("", text);
}

std::string estimate_text(const Estimate& estimate) {
    std::string about = fmt::format("{} images", estimate.images);
    if (std::isnan(estimate.hours)) {
        about += "; a ping has no room in memory";
    } else {
        const double set_up_s = estimate.set_up_s;
        about += fmt::format(
            ", {} on {} threads after {} of set-up, {}", duration_text(3600.0 * estimate.hours),
            tbb::info::default_concurrency(),
            set_up_s < 60.0 ? fmt::format("{:.2g} s", set_up_s) : duration_text(set_up_s),
            size_text(estimate.bytes));
    }
    return result_line("dataset", fmt::format("{} pings", estimate.pings)) +
           result_line("about", about);
}

void describe_estimate(const Estimate& estimate, Json& json) {
    json["pings"] = estimate.pings;
    json["images"] = estimate.images;
    json["set_up_seconds"] = estimate.set_up_s;
    json["hours"] = estimate.hours;
    json["bytes"] = estimate.bytes;
}

Json warnings_json(std::span<const Warning> warnings) {
    Json out = Json::array();
    for (const Warning& warning : warnings) {
        out.push_back({{"number", number_of(warning.code)},
                       {"about", warning.about},
                       {"what", warning.what},
                       {"cure", warning.cure}});
    }
    return out;
}

}  // namespace sonarsim
