#include "format/picture_encoder.h"

#include <array>
#include <stdexcept>

#include "core/module.h"

namespace sonarsim {

namespace {

void keep_bytes(void* user, const void* bytes, std::size_t size) {
    static_cast<std::string*>(user)->assign(static_cast<const char*>(bytes), size);
}

}  // namespace

PictureEncoder::PictureEncoder()
    : encode_(reinterpret_cast<SonarsimEncodePicture>(
          module_symbol(image_module, encode_module_symbol, image_package))) {}

std::string PictureEncoder::encode(const SonarsimPicture& picture) const {
    std::string bytes;
    std::array<char, 400> error{};
    if (encode_(&picture, &keep_bytes, &bytes, error.data(), error.size()) != 0) {
        throw std::runtime_error(std::string("OpenImageIO does not write ") + picture.format +
                                 ": " + error.data());
    }
    return bytes;
}

}  // namespace sonarsim
