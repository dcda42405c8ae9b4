#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "scene/images/read_image.h"

// Any bytes as an image and as the world file next to it, read with the limits of a mission: as
// many values as the image states and a grid of finite numbers, or InputError.

using namespace sonarsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path folder = [] {
        auto path =
            std::filesystem::temp_directory_path() / ("fuzz_images_" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    write_file(folder / "x.tif", bytes);
    write_file(folder / "x.tfw", bytes.substr(bytes.size() / 2));
    try {
        const Image image = read_image(folder / "x.tif");
        const std::size_t stated = static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height) *
                                   static_cast<std::size_t>(image.channels);
        if (stated == 0 || stated > max_image_values || image.values.size() != stated) std::abort();
        if (image.grid && !(std::isfinite(image.grid->x_m) && image.grid->column_m != 0.0))
            std::abort();
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
