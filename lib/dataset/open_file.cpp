#include "dataset/open_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/file.h"
#include "dataset/npy.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_json = std::size_t{1} << 28;
constexpr std::size_t longest_npy_header = 4096;
/// Of an image, what is decoded at a time.
constexpr std::size_t strip_bytes = std::size_t{1} << 22;

/// Pictures may be longer than memory: they are decoded strip by strip and dropped.
std::vector<std::size_t> open_image(const fs::path& path, const char* format) {
    const auto in = OIIO::ImageInput::open(path.string());
    if (!in) throw std::runtime_error(OIIO::geterror());
    if (std::string(in->format_name()) != format)
        throw std::runtime_error(std::string("is no ") + format + " file");
    const OIIO::ImageSpec& spec = in->spec();
    const auto row_bytes = static_cast<std::size_t>(spec.scanline_bytes(true));
    const int rows = static_cast<int>(std::max<std::size_t>(1, strip_bytes / row_bytes));
    std::vector<std::byte> strip(rows * row_bytes);
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(y + rows, spec.height);
        if (!in->read_scanlines(0, 0, y, end, 0, 0, spec.nchannels, spec.format, strip.data()))
            throw std::runtime_error(in->geterror());
    }
    return {static_cast<std::size_t>(spec.height), static_cast<std::size_t>(spec.width)};
}

std::vector<std::size_t> open_npy(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string start(longest_npy_header, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    const NpyFormat format = npy_format(start);
    std::uint64_t bytes = format.type == "<f8" ? 8 : 4;
    for (const std::size_t length : format.shape)
        bytes *= length;
    bytes += npy_header(format).size();
    if (fs::file_size(path) != bytes) {
        throw std::runtime_error("is " + std::to_string(fs::file_size(path)) +
                                 " bytes long instead of " + std::to_string(bytes));
    }
    return format.shape;
}

}  // namespace

std::vector<std::size_t> open_file(const fs::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return open_image(path, "png");
    if (extension == ".tif") return open_image(path, "tiff");
    if (extension == ".npy") return open_npy(path);
    if (extension == ".json" && !nlohmann::json::accept(read_file(path, largest_json)))
        throw std::runtime_error("is no JSON");
    return {};
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape)
        text += (text.empty() ? "" : " x ") + std::to_string(length);
    return text;
}

}  // namespace sonarsim
