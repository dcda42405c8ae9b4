#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.h"
#include "dataset/checked_json.h"
#include "dataset/description.h"

// Any bytes as dataset.json: a description whose files all lie below the folder, or InputError.

using namespace sonarsim;

namespace {

/// True if the path stays in the folder that it starts from.
bool stays_below(const std::string& name) {
    const std::filesystem::path path(name);
    if (name.empty() || name.find('\0') != std::string::npos || !path.is_relative()) return false;
    for (const std::filesystem::path& step : path) {
        if (step == ".." || step == ".") return false;
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        const DatasetFile dataset = check_description(parse_json(text, "in.json"), "in.json");
        int files = 0;
        for_each_described(dataset, [&](const DescribedFile& file) {
            if (!stays_below(file.name)) std::abort();
            return ++files < 1000;
        });
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
