#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "format/picture_module.h"
#include "guarded.h"

// Pictures into memory through OpenImageIO.

namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// OpenImageIO starts no threads: each thread of the program encodes pictures of its own.
void use_no_threads() {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);  // none
    });
}

TypeDesc type_in_file(const SonarsimChannel& channel, bool is_exr) {
    if (channel.type == 4) return TypeDesc::FLOAT;
    if (channel.type == 2) return is_exr ? TypeDesc::UINT32 : TypeDesc::UINT16;
    return is_exr ? TypeDesc::HALF : TypeDesc::UINT8;
}

void put_value(const void* value, std::uint32_t type, bool is_exr, std::uint8_t* out) {
    if (type == 2 && is_exr) {
        std::uint16_t whole = 0;
        std::memcpy(&whole, value, sizeof whole);
        const std::uint32_t wide = whole;
        std::memcpy(out, &wide, sizeof wide);
    } else if (type == 1 && is_exr) {
        const half exact(static_cast<float>(*static_cast<const std::uint8_t*>(value)));
        std::memcpy(out, &exact, sizeof exact);
    } else {
        std::memcpy(out, value, type);
    }
}

ImageSpec spec_of(const SonarsimPicture& picture) {
    const bool is_exr = std::string_view(picture.format) == "openexr";
    ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height),
                   static_cast<int>(picture.channel_count), TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (std::size_t k = 0; k < picture.channel_count; ++k) {
        spec.channelnames.emplace_back(picture.channels[k].name);
        spec.channelformats.push_back(type_in_file(picture.channels[k], is_exr));
    }
    if (!is_exr) {
        spec.set_format(spec.channelformats.front());
        spec.channelformats.clear();
    }
    spec.alpha_channel = -1;
    spec.attribute("Compression", is_exr ? "none" : std::string(picture.format) + ":90");
    spec.attribute("DateTime", "");  // else it is the time of writing
    if (*picture.description != '\0') spec.attribute("ImageDescription", picture.description);
    for (std::size_t k = 0; k < picture.attribute_count; ++k) {
        const SonarsimAttribute& one = picture.attributes[k];
        spec.attribute(one.name, TypeDesc(TypeDesc::FLOAT, static_cast<int>(one.count)),
                       one.numbers);
    }
    return spec;
}

/// The values as they will be in the file, pixel by pixel.
std::vector<std::uint8_t> pixels_of(const SonarsimPicture& picture, const ImageSpec& spec) {
    const bool is_exr = !spec.channelformats.empty();
    const std::size_t pixels = std::size_t{picture.width} * picture.height;
    const std::size_t pixel_bytes = spec.pixel_bytes(true);
    std::vector<std::uint8_t> bytes(pixels * pixel_bytes);
    std::size_t offset = 0;
    for (std::size_t k = 0; k < picture.channel_count; ++k) {
        const SonarsimChannel& channel = picture.channels[k];
        const auto* value = static_cast<const std::uint8_t*>(channel.values);
        std::uint8_t* out = bytes.data() + offset;
        for (std::size_t i = 0; i < pixels; ++i, value += channel.step, out += pixel_bytes)
            put_value(value, channel.type, is_exr, out);
        offset += spec.channelformat(static_cast<int>(k)).size();
    }
    return bytes;
}

std::vector<unsigned char> encode(const SonarsimPicture& picture) {
    use_no_threads();
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(picture.format);
    if (!output) throw std::runtime_error(OIIO::geterror());
    ImageSpec spec = spec_of(picture);
    const std::vector<std::uint8_t> pixels = pixels_of(picture, spec);
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    spec.attribute("oiio:ioproxy", TypeDesc::PTR, static_cast<void*>(&proxy));
    // No file of this name is written: `memory` takes the bytes.
    if (!output->open(std::string("memory.") + picture.format, spec) ||
        !output->write_image(TypeDesc::UNKNOWN, pixels.data()) || !output->close())
        throw std::runtime_error(output->geterror());
    return file;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_encode_picture_1(
    const SonarsimPicture* picture, SonarsimTakeBytes take, void* user, char* error,
    std::size_t error_size) {
    return guarded(error, error_size, [&] {
        const std::vector<unsigned char> file = encode(*picture);
        take(user, file.data(), file.size());
    });
}
