#include "format/open_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

#include "format/exr_shape.h"
#include "format/geotiff.h"
#include "format/npy.h"
#include "format/png_reader.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_header = 4096;
/// Bytes that are read at a time.
constexpr std::size_t strip_bytes = std::size_t{1} << 22;

/// The largest of values of 16 bits.
std::uint16_t largest_of(std::span<const std::byte> bytes) {
    std::uint16_t largest = 0;
    for (std::size_t k = 0; k + 2 <= bytes.size(); k += 2) {
        std::uint16_t value = 0;
        std::memcpy(&value, &bytes[k], 2);
        largest = std::max(largest, value);
    }
    return largest;
}

/// Decodes a picture row by row, since it may be longer than memory. `bytes` is the file's length.
OpenedFile open_png(std::istream& file, std::uint64_t bytes) {
    std::uint16_t largest = 0;
    bool has_ids = false;
    const PngShape shape =
        read_png(file, bytes, [&](const PngShape& of, std::span<const std::uint8_t> row) {
            has_ids = of.bits == 16 && of.channels == 1;
            for (std::size_t k = 0; has_ids && k < row.size(); k += 2)
                largest = std::max(largest, static_cast<std::uint16_t>(row[k] << 8 | row[k + 1]));
        });
    return {{static_cast<std::size_t>(shape.height), static_cast<std::size_t>(shape.width)},
            has_ids ? std::optional(largest) : std::nullopt};
}

/// `bytes` is the size of the file.
OpenedFile open_geotiff(std::istream& file, std::uint64_t bytes) {
    std::string start(longest_header, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    const GeotiffShape shape = geotiff_shape(start);
    if (bytes != shape.file_bytes) {
        throw std::runtime_error("is " + std::to_string(bytes) + " bytes long instead of " +
                                 std::to_string(shape.file_bytes));
    }
    return {{shape.rows, shape.columns}};
}

OpenedFile open_exr(std::istream& file, std::uint64_t bytes) {
    const ExrShape shape = exr_shape(file, bytes);
    return {{shape.rows, shape.columns}};
}

/// `file` is at its start and has `bytes` bytes.
OpenedFile open_npy(std::istream& file, std::uint64_t bytes) {
    std::string start(longest_header, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    const NpyFormat format = npy_format(start);
    std::uint64_t expected = static_cast<std::uint64_t>(format.type.back() - '0');
    for (const std::size_t length : format.shape) {
        // The product of the lengths may overflow to any number.
        if (length > 0 && expected > std::numeric_limits<std::uint64_t>::max() / length)
            throw std::runtime_error("names more values than any file holds");
        expected *= length;
    }
    const std::size_t header = npy_header(format).size();
    expected += header;
    if (bytes != expected) {
        throw std::runtime_error("is " + std::to_string(bytes) + " bytes long instead of " +
                                 std::to_string(expected));
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

/// `file` has `bytes` bytes and this extension.
OpenedFile open_stream(const std::string& extension, std::istream& file, std::uint64_t bytes) {
    if (extension == ".png") return open_png(file, bytes);
    if (extension == ".tif") return open_geotiff(file, bytes);
    if (extension == ".exr") return open_exr(file, bytes);
    if (extension == ".npy") return open_npy(file, bytes);
    if (extension == ".json") open_json(file);  // COCO files may be longer than memory
    return {};
}

}  // namespace

OpenedFile open_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return open_stream(path.extension().string(), file, fs::file_size(path));
}

OpenedFile open_bytes(const std::string& name, const std::string& bytes) {
    std::istringstream file(bytes);
    return open_stream(fs::path(name).extension().string(), file, bytes.size());
}

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t length : shape)
        text += (text.empty() ? "" : " x ") + std::to_string(length);
    return text;
}

}  // namespace sonarsim
