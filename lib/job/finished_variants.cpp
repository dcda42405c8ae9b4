#include "job/finished_variants.h"

#include <stdexcept>

#include "core/sha256.h"
#include "dataset/dataset_file.h"
#include "dataset/description.h"
#include "dataset/metadata.h"
#include "job/folder.h"
#include "mission/files.h"
#include "mission/resolved.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

}  // namespace

std::optional<std::uint64_t> FinishedVariants::operator()(const Mission& variant) try {
    const fs::path& folder = variant.output.folder;
    if (!fs::exists(folder / description_name)) return std::nullopt;
    const DatasetFile found = require_dataset(folder);
    const Json expected = {{"format_version", dataset_format_version},
                           {"program_version", SONARSIM_VERSION},
                           {"build", describe_build()},
                           {"mission_hash", mission_hash(variant, sonar_keys())},
                           {"inputs_hash", found.json.at("inputs_hash")}};
    if (!found.complete || !difference_between(found.json, expected).empty()) return std::nullopt;
    for (const Json& input : found.json.at("inputs")) {
        const fs::path file = home_of(variant) / input.at("file").get<std::string>();
        const auto [sum, is_new] = sums_.try_emplace(file);
        if (is_new) sum->second = sha256_of_file(file);
        if (sum->second != input.at("sha256").get<std::string>()) return std::nullopt;
    }
    if (!has_files(folder, found)) return std::nullopt;
    std::uint64_t pings = 0;
    for (const DescribedSensor& sensor : found.sensors)
        pings += sensor.pings;
    return pings;
} catch (const Json::exception&) {
    return std::nullopt;  // run_job() says what is wrong
} catch (const std::runtime_error&) {
    return std::nullopt;
}

}  // namespace sonarsim
