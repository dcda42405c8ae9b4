#include "dataset/open_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dataset/npy.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_npy_header = 4096;
/// Of an image, what is decoded at a time.
constexpr std::size_t strip_bytes = std::size_t{1} << 22;

/// Of values of 16 bits.
std::uint16_t largest_of(std::span<const std::byte> bytes) {
    std::uint16_t largest = 0;
    for (std::size_t k = 0; k + 2 <= bytes.size(); k += 2) {
        std::uint16_t value = 0;
        std::memcpy(&value, &bytes[k], 2);
        largest = std::max(largest, value);
    }
    return largest;
}

/// Pictures may be longer than memory: they are decoded strip by strip and dropped. `bytes`: the
/// file, where it is in memory.
OpenedFile open_image(const std::string& name, const char* format,
                      OIIO::Filesystem::IOProxy* bytes) {
    const auto in = OIIO::ImageInput::open(name, nullptr, bytes);
    if (!in) throw std::runtime_error(OIIO::geterror());
    if (std::string(in->format_name()) != format)
        throw std::runtime_error(std::string("is no ") + format + " file");
    const OIIO::ImageSpec& spec = in->spec();
    const auto row_bytes = static_cast<std::size_t>(spec.scanline_bytes(true));
    const int rows = static_cast<int>(std::max<std::size_t>(1, strip_bytes / row_bytes));
    std::vector<std::byte> strip(rows * row_bytes);
    const bool has_ids = spec.format == OIIO::TypeDesc::UINT16 && spec.nchannels == 1;
    std::uint16_t largest = 0;
    for (int y = 0; y < spec.height; y += rows) {
        const int end = std::min(y + rows, spec.height);
        if (!in->read_scanlines(0, 0, y, end, 0, 0, spec.nchannels, spec.format, strip.data()))
            throw std::runtime_error(in->geterror());
        if (has_ids)
            largest = std::max(largest, largest_of(std::span(strip).first((end - y) * row_bytes)));
    }
    return {{static_cast<std::size_t>(spec.height), static_cast<std::size_t>(spec.width)},
            has_ids ? std::optional(largest) : std::nullopt};
}

/// `file` is at its begin and `bytes` long.
OpenedFile open_npy(std::istream& file, std::uint64_t bytes) {
    std::string start(longest_npy_header, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    const NpyFormat format = npy_format(start);
    std::uint64_t told = static_cast<std::uint64_t>(format.type.back() - '0');
    for (const std::size_t length : format.shape)
        told *= length;
    const std::size_t header = npy_header(format).size();
    told += header;
    if (bytes != told) {
        throw std::runtime_error("is " + std::to_string(bytes) + " bytes long instead of " +
                                 std::to_string(told));
    }
    if (format.type != "<u2") return {format.shape};
    file.clear();
    file.seekg(static_cast<std::streamoff>(header));
    std::uint16_t largest = 0;
    std::vector<std::byte> strip(strip_bytes);
    for (std::uint64_t left = bytes - header; left > 0;) {
        const std::size_t count = std::min<std::uint64_t>(left, strip.size());
        if (!file.read(reinterpret_cast<char*>(strip.data()), static_cast<std::streamsize>(count)))
            throw std::runtime_error("cannot be read");
        largest = std::max(largest, largest_of(std::span(strip).first(count)));
        left -= count;
    }
    return {format.shape, largest};
}

void open_json(std::istream& file) {
    if (!nlohmann::json::accept(file)) throw std::runtime_error("is no JSON");
}

}  // namespace

OpenedFile open_file(const fs::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".png") return open_image(path.string(), "png", nullptr);
    if (extension == ".tif") return open_image(path.string(), "tiff", nullptr);
    std::ifstream file(path, std::ios::binary);
    if (extension == ".npy") return open_npy(file, fs::file_size(path));
    if (extension == ".json") open_json(file);  // COCO files may be longer than memory
    return {};
}

OpenedFile open_bytes(const std::string& name, const std::string& bytes) {
    const std::string extension = fs::path(name).extension().string();
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    if (extension == ".png") return open_image(name, "png", &memory);
    std::istringstream file(bytes);
    if (extension == ".npy") return open_npy(file, bytes.size());
    if (extension == ".json") open_json(file);
    return {};
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape)
        text += (text.empty() ? "" : " x ") + std::to_string(length);
    return text;
}

}  // namespace sonarsim
