#pragma once

#include <OpenImageIO/imageio.h>

#include "support/test.h"

namespace sonarsim::test {

/// The values of an image file of this size, as OpenImageIO reads them; T is their type.
template <class T>
std::vector<T> pixels_of(const std::filesystem::path& path, int width, int height, int channels) {
    const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
    const auto file = OIIO::ImageInput::open(path.string());
    REQUIRE(file);
    CHECK(file->spec().width == width);
    CHECK(file->spec().height == height);
    CHECK(file->spec().nchannels == channels);
    CHECK(file->spec().format == type);
    std::vector<T> values(file->spec().image_pixels() * channels);
    REQUIRE(file->read_image(0, 0, 0, channels, type, values.data()));
    return values;
}

}  // namespace sonarsim::test
