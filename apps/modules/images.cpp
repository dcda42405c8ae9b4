#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "guarded.h"
#include "scene/images/module.h"

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
    if (!input->open(file, spec, wishes)) throw std::runtime_error(input->geterror());
    return input;
}

/// All channels are read as numbers of one type. To convert whole numbers, OpenImageIO would scale
/// them to 0 to 1.
void require_one_type(const ImageSpec& spec) {
    for (const TypeDesc& format : spec.channelformats) {
        const bool is_half = format == TypeDesc::HALF && spec.format == TypeDesc::FLOAT;
        if (format == spec.format || is_half) continue;
        throw std::runtime_error(
            "channels of different types are not read; write the one that is needed to an image "
            "of its own");
    }
}

template <class T>
void read_rows(ImageInput& input, const ImageSpec& spec, TypeDesc type, SonarsimImageRows rows,
               void* user) {
    const auto row =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels);
    std::vector<T> pixels(row * static_cast<std::size_t>(spec.height));
    if (!input.read_image(0, 0, 0, spec.nchannels, type, pixels.data()))
        throw std::runtime_error(input.geterror());
    std::vector<float> values(row);
    for (std::size_t begin = 0; begin < pixels.size(); begin += row) {
        for (std::size_t i = 0; i < row; ++i)
            values[i] = static_cast<float>(pixels[begin + i]);
        rows(user, values.data(), row);
    }
}

void read_pixels(ImageInput& input, const ImageSpec& spec, SonarsimImageRows rows, void* user) {
    switch (spec.format.basetype) {
        case TypeDesc::UINT8:
            return read_rows<std::uint8_t>(input, spec, TypeDesc::UINT8, rows, user);
        case TypeDesc::INT8:
            return read_rows<std::int8_t>(input, spec, TypeDesc::INT8, rows, user);
        case TypeDesc::UINT16:
            return read_rows<std::uint16_t>(input, spec, TypeDesc::UINT16, rows, user);
        case TypeDesc::INT16:
            return read_rows<std::int16_t>(input, spec, TypeDesc::INT16, rows, user);
        case TypeDesc::UINT32:
            return read_rows<std::uint32_t>(input, spec, TypeDesc::UINT32, rows, user);
        case TypeDesc::INT32:
            return read_rows<std::int32_t>(input, spec, TypeDesc::INT32, rows, user);
        case TypeDesc::HALF:
        case TypeDesc::FLOAT:
            return read_rows<float>(input, spec, TypeDesc::FLOAT, rows, user);
        case TypeDesc::DOUBLE:
            return read_rows<double>(input, spec, TypeDesc::DOUBLE, rows, user);
        default:
            throw std::runtime_error(std::string("samples of the type ") + spec.format.c_str() +
                                     " are not read; make numbers of 32 bits of them with "
                                     "gdal_translate -ot Float32");
    }
}

bool is_whole(const ImageSpec& spec) {
    const auto type = spec.format.basetype;
    return type != TypeDesc::HALF && type != TypeDesc::FLOAT && type != TypeDesc::DOUBLE;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_read_image_1(
    const char* format, const char* file, SonarsimImageStart start, SonarsimImageRows rows,
    void* user, char* error, std::size_t error_size) {
    return guarded(error, error_size, [&] {
        ImageSpec spec;
        const std::unique_ptr<ImageInput> input = open_image(format, file, spec);
        const auto bits = static_cast<unsigned>(8 * spec.format.size());
        if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep)
            throw std::runtime_error("it is no flat image with pixels");
        const SonarsimImageHead head{
            static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height),
            static_cast<std::uint32_t>(spec.nchannels), bits, is_whole(spec) ? 0U : 1U};
        if (start(user, &head) != 0) return;
        require_one_type(spec);
        read_pixels(*input, spec, rows, user);
    });
}
