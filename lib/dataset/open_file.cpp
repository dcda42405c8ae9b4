#include "dataset/open_file.h"

#include <OpenImageIO/filesystem.h>
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

/// Pictures may be longer than memory: they are decoded strip by strip and dropped. `bytes`: the
/// file, where it is in memory.
std::vector<std::size_t> open_image(const std::string& name, const char* format,
                                    OIIO::Filesystem::IOProxy* bytes) {
    const auto in = OIIO::ImageInput::open(name, nullptr, bytes);
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

/// `start` of a file of `bytes` bytes.
std::vector<std::size_t> open_npy(std::string_view start, std::uint64_t bytes) {
    const NpyFormat format = npy_format(start);
    std::uint64_t told = static_cast<std::uint64_t>(format.type.back() - '0');
    for (const std::size_t length : format.shape)
        told *= length;
    told += npy_header(format).size();
    if (bytes != told) {
        throw std::runtime_error("is " + std::to_string(bytes) + " bytes long instead of " +
                                 std::to_string(told));
    }
    return format.shape;
}

void open_json(const std::string& bytes) {
    if (!nlohmann::json::accept(bytes)) throw std::runtime_error("is no JSON");
}

}  // namespace

std::vector<std::size_t> open_file(const fs::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return open_image(path.string(), "png", nullptr);
    if (extension == ".tif") return open_image(path.string(), "tiff", nullptr);
    if (extension == ".json") open_json(read_file(path, largest_json));
    if (extension != ".npy") return {};
    std::ifstream file(path, std::ios::binary);
    std::string start(longest_npy_header, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    return open_npy(start, fs::file_size(path));
}

std::vector<std::size_t> open_bytes(const std::string& name, const std::string& bytes) {
    const std::string extension = fs::path(name).extension().string();
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    if (extension == ".png") return open_image(name, "png", &memory);
    if (extension == ".npy")
        return open_npy(std::string_view(bytes).substr(0, longest_npy_header), bytes.size());
    if (extension == ".json") open_json(bytes);
    return {};
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape)
        text += (text.empty() ? "" : " x ") + std::to_string(length);
    return text;
}

}  // namespace sonarsim
