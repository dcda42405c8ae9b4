#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "core/module.h"
#include "scene/images/module.h"
#include "scene/images/read_image.h"

// Any bytes as an image, read with the limits of a mission: as many values as the image tells, or
// InputError.

using namespace sonarsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path file = [] {
        // Each image has a child of its own, which finds OpenImageIO loaded: that takes 0.2 s.
        module_symbol(image_module, image_module_symbol, "libopenimageio-dev");
        return std::filesystem::temp_directory_path() / ("fuzz_images_" + std::to_string(getpid()));
    }();
    write_file(file, std::string_view(reinterpret_cast<const char*>(data), size));
    try {
        const Image image = read_image(file);
        const std::size_t stated = static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height) *
                                   static_cast<std::size_t>(image.channels);
        if (stated == 0 || stated > most_image_values || image.values.size() != stated)
            std::abort();
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
