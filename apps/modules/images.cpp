#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "guarded.h"
#include "tiff_header.h"

// PNG, TIFF and OpenEXR through OpenImageIO. Pixels keep their values in the file: by default
// OpenImageIO would scale whole numbers to 0 to 1 and multiply colours by the alpha channel.

namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::unique_ptr<ImageInput> open_image(const char* format, const char* file, ImageSpec& spec) {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);  // none
    std::unique_ptr<ImageInput> input = ImageInput::create(format);
    if (!input) throw std::runtime_error(OIIO::geterror());
    ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(file, spec, wishes))
        throw std::runtime_error(input->geterror() + " (OpenImageIO)");
    return input;
}

/// All channels are read as one type: to convert whole numbers, OpenImageIO would scale them.
void require_one_type(const ImageSpec& spec) {
    for (const TypeDesc& format : spec.channelformats) {
        const bool is_half = format == TypeDesc::HALF && spec.format == TypeDesc::FLOAT;
        if (format == spec.format || is_half) continue;
        throw std::runtime_error(
            "channels of different types are not read; write the one that is needed to an image "
            "of its own");
    }
}

/// OpenImageIO scales the numbers of a grey PNG of few bits to 8 bits.
void require_whole_bytes(const char* file) {
    // Signature, length and name of the head, width, height; then bits of a number, and colours.
    std::array<char, 26> start{};
    std::ifstream(file, std::ios::binary).read(start.data(), start.size());
    constexpr char grey = 0;
    if (start[25] != grey || start[24] >= 8) return;
    throw std::runtime_error("its numbers have " + std::to_string(start[24]) +
                             " bits; save it with 8 or 16 bits");
}

static_assert(std::endian::native == std::endian::little, "as the numbers of the file are");

std::uint32_t read_number(std::istream& in) {
    std::uint32_t number = 0;
    in.read(reinterpret_cast<char*>(&number), sizeof number);
    return number;
}

/// The length of a text that ends with a zero. One beyond the format's limit fails the stream.
std::streamsize skip_text(std::istream& in) {
    char text[257];
    in.getline(text, std::size(text), '\0');
    return in.gcount() - 1;
}

/// Skips a list of attributes (name, type, size, value). Returns how many it has.
int skip_attributes(std::istream& in, std::uint64_t file_bytes) {
    int count = 0;
    for (; in && skip_text(in) > 0; ++count) {
        skip_text(in);
        const std::uint32_t bytes = read_number(in);
        const auto position = in.tellg();
        if (position < 0 || bytes > file_bytes - static_cast<std::uint64_t>(position))
            in.setstate(std::ios::failbit);
        else
            in.seekg(bytes, std::ios::cur);
    }
    return count;
}

/// OpenEXR reserves the bytes that an attribute states before it reads them: a file of 300 bytes
/// could take 4 GB. std::runtime_error unless the attributes of all parts lie in the file.
/// Layout: "OpenEXR File Layout", sections "Magic Number" to "Header", of the OpenEXR project.
void check_exr_header(const char* file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const auto file_bytes = static_cast<std::uint64_t>(in.tellg());
    in.seekg(4);
    constexpr std::uint32_t has_parts = 0x1000;
    const bool is_one_part = (read_number(in) & has_parts) == 0;
    // An empty list follows the lists of several parts.
    while (in && skip_attributes(in, file_bytes) > 0 && !is_one_part) {
    }
    if (!in) throw std::runtime_error("its header is damaged: copy or export it again");
}

/// Reads the pixels if they are of `type`, that of T, or half where it is FLOAT; else false.
template <class T, TypeDesc::BASETYPE type>
bool read_values(ImageInput& input, const ImageSpec& spec, float* values) {
    const bool is_half = type == TypeDesc::FLOAT && spec.format.basetype == TypeDesc::HALF;
    if (spec.format.basetype != type && !is_half) return false;
    std::vector<T> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, type, pixels.data()))
        throw std::runtime_error(input.geterror() + " (OpenImageIO)");
    std::ranges::transform(pixels, values, [](T pixel) { return static_cast<float>(pixel); });
    return true;
}

void read_pixels(ImageInput& input, const ImageSpec& spec, float* values) {
    const bool is_read = read_values<std::uint8_t, TypeDesc::UINT8>(input, spec, values) ||
                         read_values<std::int8_t, TypeDesc::INT8>(input, spec, values) ||
                         read_values<std::uint16_t, TypeDesc::UINT16>(input, spec, values) ||
                         read_values<std::int16_t, TypeDesc::INT16>(input, spec, values) ||
                         read_values<std::uint32_t, TypeDesc::UINT32>(input, spec, values) ||
                         read_values<std::int32_t, TypeDesc::INT32>(input, spec, values) ||
                         read_values<float, TypeDesc::FLOAT>(input, spec, values) ||
                         read_values<double, TypeDesc::DOUBLE>(input, spec, values);
    if (is_read) return;
    throw std::runtime_error(std::string("samples of the type ") + spec.format.c_str() +
                             " are not read; make numbers of 32 bits of them with "
                             "gdal_translate -ot Float32");
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_read_image_5(const char* format,
                                                                    const char* file,
                                                                    SonarsimImageStart start,
                                                                    void* user, char* error,
                                                                    std::size_t error_size) {
    return guarded(error, error_size, [&] {
        SonarsimImageHead head{};
        if (std::strcmp(format, "png") == 0) require_whole_bytes(file);
        if (std::strcmp(format, "openexr") == 0) check_exr_header(file);
        if (std::strcmp(format, "tiff") == 0) read_tiff_header(file, head);
        ImageSpec spec;
        const std::unique_ptr<ImageInput> input = open_image(format, file, spec);
        if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep)
            throw std::runtime_error("it is not a flat image with pixels");
        head.width = static_cast<std::uint64_t>(spec.width);
        head.height = static_cast<std::uint64_t>(spec.height);
        head.channels = static_cast<std::uint32_t>(spec.nchannels);
        head.bits = static_cast<std::uint32_t>(8 * spec.format.size());
        head.is_float = spec.format.is_floating_point() ? 1U : 0U;
        float* const values = start(user, &head);
        if (values == nullptr) return;
        require_one_type(spec);
        read_pixels(*input, spec, values);
    });
}
