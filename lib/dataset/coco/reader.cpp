#include "dataset/coco/reader.h"

#include <cstddef>
#include <fstream>
#include <memory>

#include "core/error.h"

namespace sonarsim {

namespace {

/// The mask of an object in a waterfall of 60,000 pings takes a few megabytes.
constexpr std::streamsize longest_line = std::streamsize{1} << 26;

}  // namespace

void read_coco(const std::filesystem::path& file, std::string_view list,
               const std::function<void(const CheckedJson& item)>& visit) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError({file.string()}, "cannot be opened");
    // Not initialised, since most lines fill only a small part of the buffer.
    const auto buffer = std::make_unique_for_overwrite<char[]>(longest_line);
    const std::string begins = "\"" + std::string(list) + "\": [";
    bool is_inside = false;
    for (std::size_t number = 1; in.getline(buffer.get(), longest_line); ++number) {
        std::string_view line = buffer.get();
        if (line == "]}") return;
        if (line.ends_with(',')) line.remove_suffix(1);
        if (line.starts_with('"') || line == "]") is_inside = line == begins;
        if (!is_inside || line == begins) continue;
        const std::string place = file.string() + ":" + std::to_string(number);
        const nlohmann::ordered_json item = parse_json(std::string(line), place);
        visit(CheckedJson(item, place));
    }
    throw InputError({file.string()}, "is cut off, or no COCO file of sonarsim");
}

}  // namespace sonarsim
