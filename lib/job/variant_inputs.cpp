#include "job/variant_inputs.h"

#include <map>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "dataset/description.h"
#include "dataset/ping_metadata.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The texts that were drawn for a variant: variants with the same ones name the same files.
std::string drawn_texts(const Json& description) {
    const Json variant = description.value("variant", Json::object());
    const Json drawn = variant.is_object() ? variant.value("drawn", Json::object()) : Json();
    std::string texts;
    for (const auto& [key, value] : drawn.items()) {
        if (value.is_string()) texts += key + '=' + value.dump() + '\n';
    }
    return texts;
}

/// The properties, by name, that variants with the same texts must share.
std::map<std::string, std::string> inputs_of(const Json& description) {
    std::map<std::string, std::string> inputs{{"the build", bytes_of_build(description)}};
    for (const Json& input : description.value("inputs", Json::array())) {
        if (!input.is_object()) continue;
        inputs[input.value("file", Json()).dump()] = input.value("sha256", Json()).dump();
    }
    return inputs;
}

/// The first variant that has an input, and its bytes.
struct Source {
    std::string bytes;
    std::string variant;
};

}  // namespace

void require_same_inputs(const std::vector<fs::path>& folders, const Json& next) {
    std::map<std::string, Source> known;
    const auto add = [&](const Json& description, const std::string& variant) {
        const std::string texts = drawn_texts(description);
        for (const auto& [name, bytes] : inputs_of(description)) {
            const auto [first, is_new] = known.try_emplace(texts + name, Source{bytes, variant});
            if (is_new || first->second.bytes == bytes) continue;
            throw InputError({variant}, "differs from " + first->second.variant + " in " +
                                            printable(name) +
                                            ": all variants of a mission need the same input files "
                                            "and build; choose another output folder, or render "
                                            "those variants again");
        }
    };
    if (!next.is_null()) add(next, "the files of this run");
    for (const fs::path& folder : folders) {
        if (!fs::exists(folder / description_name)) continue;
        if (const std::optional<Json> description = read_description(folder))
            add(*description, folder.string());
    }
}

}  // namespace sonarsim
