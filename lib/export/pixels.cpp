#include "export/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "format/npy.h"
#include "format/png.h"
#include "format/png_reader.h"
#include "format/tar.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_side = std::size_t{1} << 20;
constexpr std::size_t largest_picture_bytes = std::size_t{1} << 32;

/// grey_of() of all values of 16 bits.
const std::array<std::uint8_t, 65536>& grey_of_16_bits() {
    static const auto table = [] {
        std::array<std::uint8_t, 65536> greys{};
        for (std::size_t k = 0; k < greys.size(); ++k)
            greys[k] = grey_of(static_cast<double>(k) / 65535.0);
        return greys;
    }();
    return table;
}

void require_size(int width, int height, const SourcePicture& picture) {
    if (width != picture.width || height != picture.height)
        throw std::runtime_error("has not the size that the COCO file says");
}

Pixels pixels_of_png(const std::string& bytes, const SourcePicture& picture) {
    std::istringstream stream(bytes);
    Pixels pixels;
    const auto& greys = grey_of_16_bits();
    const PngShape shape =
        read_png(stream, bytes.size(), [&](const PngShape& own, std::span<const std::uint8_t> row) {
            require_size(own.width, own.height, picture);
            if (own.bits == 8) {
                pixels.values.insert(pixels.values.end(), row.begin(), row.end());
                return;
            }
            for (std::size_t k = 0; k + 1 < row.size(); k += 2)
                pixels.values.push_back(greys[row[k] * std::size_t{256} + row[k + 1]]);
        });
    pixels.width = shape.width;
    pixels.height = shape.height;
    pixels.channels = shape.channels;
    pixels.is_changed = shape.bits == 16;
    return pixels;
}

/// The pixels of float32 [rows, columns].
Pixels pixels_of_npy(const std::string& bytes, const SourcePicture& picture) {
    const NpyFormat format = npy_format(bytes);
    const std::size_t header = npy_header(format).size();
    if (format.type != "<f4" || format.fortran_order || format.shape.size() != 2)
        throw std::runtime_error("is no float32 array of rows and columns");
    if (format.shape[0] > longest_side || format.shape[1] > longest_side)
        throw std::runtime_error("has more rows or columns than a ping");
    const std::size_t count = format.shape[0] * format.shape[1];
    if (bytes.size() != header + 4 * count) throw std::runtime_error("is cut off");
    Pixels pixels{
        static_cast<int>(format.shape[1]), static_cast<int>(format.shape[0]), 1, {}, true};
    require_size(pixels.width, pixels.height, picture);
    pixels.values.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        float value = 0.0F;
        std::memcpy(&value, bytes.data() + header + 4 * k, 4);
        pixels.values[k] = grey_of(
            picture.full_scale > 0.0 ? static_cast<double>(value) / picture.full_scale : 0.0);
    }
    return pixels;
}

}  // namespace

std::uint8_t grey_of(double share) {
    if (!(share > 0.0)) return 0;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::min(share, 1.0))));
}

std::string PixelReader::file(const SourcePicture& picture) {
    if (picture.member.empty()) return read_file(picture.file, largest_picture_bytes);
    OpenPack& pack = packs_[picture.sensor];
    if (pack.path != picture.file) {
        const std::string end =
            picture.member.substr(picture.member.rfind('.', picture.member.rfind('.') - 1));
        pack = {picture.file, {}};
        try {
            for_each_in_tar(picture.file, [&](const std::string& name, const std::string& bytes) {
                if (name.ends_with(end)) pack.files.emplace(name, bytes);
            });
        } catch (const std::system_error&) {
            throw;
        } catch (const std::runtime_error& fault) {
            throw InputError({picture.file.string()}, fault.what());
        }
    }
    const auto found = pack.files.find(picture.member);
    if (found == pack.files.end())
        throw InputError({picture.file.string()}, "lacks " + picture.member);
    return found->second;
}

Pixels PixelReader::read(const SourcePicture& picture, const std::string& bytes) const {
    fs::path path = picture.file;
    if (!picture.member.empty()) path /= picture.member;
    const std::string name = path.string();
    const bool is_array = name.ends_with(".npy");
    if (!is_array && !name.ends_with(".png")) {
        throw InputError({name},
                         "is neither PNG nor .npy, of which pictures are exported; set "
                         "output.image: true, or for fans output.fan: true, and render it again");
    }
    try {
        return is_array ? pixels_of_npy(bytes, picture) : pixels_of_png(bytes, picture);
    } catch (const std::runtime_error& fault) {
        throw InputError({name}, fault.what());
    }
}

std::string png_of(const Pixels& pixels, const Frame& frame) {
    const bool is_whole = frame.width() == pixels.width && frame.height() == pixels.height;
    if (is_whole) return png_bytes(pixels.values, pixels.width, pixels.height, pixels.channels);
    std::vector<std::uint8_t> part;
    const auto stride = static_cast<std::size_t>(pixels.width) * pixels.channels;
    for (int y = frame.top; y < frame.bottom; ++y) {
        const auto row = pixels.values.begin() + static_cast<std::ptrdiff_t>(y * stride);
        part.insert(part.end(), row + static_cast<std::ptrdiff_t>(frame.left) * pixels.channels,
                    row + static_cast<std::ptrdiff_t>(frame.right) * pixels.channels);
    }
    return png_bytes(part, frame.width(), frame.height(), pixels.channels);
}

}  // namespace sonarsim
