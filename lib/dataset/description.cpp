#include "dataset/description.h"

#include <algorithm>

#include "core/error.h"
#include "core/file.h"
#include "dataset/layout.h"
#include "dataset/metadata.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_description = std::size_t{1} << 28;

/// What the bytes of a dataset depend on in the build that wrote it.
std::string bytes_of_build(const Json& description) {
    const Json build = description.value("build", Json());
    std::string text;
    for (const char* key : {"arithmetic", "png_encoder"}) {
        const bool told = build.is_object() && build.contains(key) && build[key].is_string();
        text += (text.empty() ? "" : ", ") + (told ? build[key].get<std::string>() : "unknown");
    }
    return text;
}

/// Returns false when `visit` did.
bool visit_sensor(const Json& sensor, const std::function<bool(const DescribedFile&)>& visit) {
    const auto pings = sensor.at("pings").get<std::uint64_t>();
    const auto every = sensor.at("every").get<std::uint64_t>();
    for (const auto& [kind, pattern] : sensor.at("files").items()) {
        for (std::uint64_t ping = 0; ping < pings; ++ping) {
            const std::string name = numbered(pattern.get<std::string>(), ping * every);
            if (name.empty()) throw InputError("'" + pattern.dump() + "' is no pattern of files");
            if (!visit({name, &sensor, kind})) return false;
        }
    }
    if (sensor.contains("packs")) {
        const Json& packs = sensor["packs"];
        const auto pattern = packs.at("file").get<std::string>();
        const auto each = packs.at("pings").get<std::uint64_t>();
        if (each == 0 || numbered(pattern, 0).empty())
            throw InputError("'packs' in dataset.json is damaged");
        for (std::uint64_t first = 0; first < pings; first += each) {
            if (!visit({numbered(pattern, first / each), &sensor, "packs"})) return false;
        }
    }
    if (sensor.contains("records")) {
        if (!visit({sensor["records"].at("file").get<std::string>(), &sensor, "records"}))
            return false;
    }
    const Json labels = sensor.value("label_records", Json::object());
    for (const auto& [label, record] : labels.items()) {
        if (!visit({record.at("file").get<std::string>(), &sensor, "label_records/" + label}))
            return false;
    }
    const Json products = sensor.value("products", Json::array());
    return std::ranges::all_of(products, [&](const Json& product) {
        return visit({product.get<std::string>(), &sensor, {}});
    });
}

}  // namespace

std::optional<Json> read_description(const std::filesystem::path& folder) {
    try {
        Json json = Json::parse(read_file(folder / description_name, largest_description));
        if (json.is_object() && json.value("format", "") == dataset_format) return json;
    } catch (const Json::exception&) {  // NOLINT(bugprone-empty-catch): not ours
    }
    return std::nullopt;
}

Json require_description(const std::filesystem::path& folder) {
    if (!std::filesystem::is_regular_file(folder / description_name)) {
        throw InputError({folder.string()},
                         "is no dataset: it has no dataset.json; give the output folder of a "
                         "render");
    }
    std::optional<Json> description = read_description(folder);
    if (!description) {
        throw InputError({(folder / description_name).string()},
                         "is not sonarsim's, or damaged; give the output folder of a render");
    }
    const Json version = description->value("format_version", Json());
    if (version != dataset_format_version) {
        throw InputError({(folder / description_name).string()},
                         "has format_version " + version.dump() + ", and this program knows " +
                             std::to_string(dataset_format_version) +
                             "; use the version that made the dataset");
    }
    return *std::move(description);
}

std::string difference_between(const Json& found, const Json& expected) {
    const auto differs = [&](const char* key) {
        return found.value(key, Json()) != expected.value(key, Json());
    };
    if (differs("mission_hash")) return "of another mission";
    if (differs("inputs_hash"))
        return "of this mission made from other scene, material or trajectory files";
    if (differs("program_version") || differs("format_version"))
        return "of this mission made by another version of sonarsim";
    const std::string theirs = bytes_of_build(found);
    const std::string ours = bytes_of_build(expected);
    if (theirs == ours) return {};
    return "of this mission made by a build of sonarsim whose bytes differ (" + theirs +
           "; this one: " + ours + ")";
}

std::string numbered(const std::string& pattern, std::uint64_t number) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string::npos) return {};
    const std::size_t end = pattern.find('d', percent);
    if (end == std::string::npos || end != percent + 3 || pattern[percent + 1] != '0') return {};
    const int digits = pattern[percent + 2] - '0';
    std::string text = std::to_string(number);
    text.insert(0, std::max(0, digits - static_cast<int>(text.size())), '0');
    return pattern.substr(0, percent) + text + pattern.substr(end + 1);
}

void for_each_described(const Json& description,
                        const std::function<bool(const DescribedFile&)>& visit) {
    for (const char* name :
         {description_name, mission_name, trajectory_name, journal_name, checksums_name}) {
        if (!visit({name, nullptr, {}})) return;
    }
    try {
        for (const Json& sensor : description.at("sensors")) {
            if (!visit_sensor(sensor, visit)) return;
        }
        for (const Json& product : description.value("products", Json::array())) {
            if (!visit({product.get<std::string>(), nullptr, {}})) return;
        }
    } catch (const Json::exception& error) {
        throw InputError({description_name}, std::string("is damaged: ") + error.what());
    }
}

}  // namespace sonarsim
