#include "scene/images/world_file.h"

#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace sonarsim {

namespace {

std::string in_capitals(std::string text) {
    for (char& letter : text)
        letter = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    return text;
}

/// The world file next to an image; empty if there is none. For ".tif" its extension is ".tfw",
/// ".tifw" or ".wld", in lower case or capitals.
std::filesystem::path find_world_file(const std::filesystem::path& image) {
    const std::string extension = image.extension().string();
    std::string brief = "." + extension.substr(extension.size() < 2 ? 0 : 1, 1);
    if (!extension.empty()) brief += extension.back();
    std::error_code ignored;
    for (const std::string& end : {brief + "w", extension + "w", std::string(".wld")}) {
        for (const std::string& name : {end, in_capitals(end)}) {
            std::filesystem::path file = image;
            file.replace_extension(name);
            if (std::filesystem::is_regular_file(file, ignored)) return file;
        }
    }
    return {};
}

}  // namespace

std::optional<PixelGrid> read_world_file(const std::filesystem::path& image) {
    const std::filesystem::path file = find_world_file(image);
    if (file.empty()) return std::nullopt;
    const Location where{file.string()};
    const std::string bytes = read_file(file, 10'000);
    std::string_view rest = bytes;
    std::array<double, 6> numbers{};
    for (double& number : numbers) {
        rest = rest.substr(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
        rest.remove_prefix(word.size());
        const auto value = parse_number(word);
        if (!value) {
            throw InputError(where,
                             "is not a world file, which has six numbers: the width of a "
                             "pixel, 0, 0, its negative height, and x and y of the centre "
                             "of the first pixel");
        }
        number = *value;
    }
    if (numbers[1] != 0.0 || numbers[2] != 0.0) {
        throw InputError(where,
                         "its rows and columns do not run along east and north; make a map of it "
                         "whose first row is the north, as with gdalwarp");
    }
    return PixelGrid{numbers[4], numbers[5], numbers[0], numbers[3]};
}

}  // namespace sonarsim
