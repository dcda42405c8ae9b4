#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "scene/images/georeference.h"
#include "scene/images/tiff_tags.h"
#include "scene/images/whole_tiff.h"

// Any bytes as a TIFF and as the world file next to it: a grid of finite numbers, none, or
// InputError.

using namespace sonarsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path folder = [] {
        auto path = std::filesystem::temp_directory_path() /
                    ("fuzz_georeference_" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    write_file(folder / "x.tif", bytes);
    write_file(folder / "x.tfw", bytes);
    try {
        if (is_tiff(folder / "x.tif")) require_whole_tiff(folder / "x.tif");
        const auto grid = read_georeference(folder / "x.tif").grid;
        if (!grid) return 0;
        const bool holds = std::isfinite(grid->x_m) && std::isfinite(grid->y_m) &&
                           std::isfinite(grid->column_m) && std::isfinite(grid->row_m) &&
                           grid->column_m != 0.0 && grid->row_m != 0.0;
        if (!holds) std::abort();
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
