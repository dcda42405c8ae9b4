#include "scene/images/side_by_side.h"

#include <algorithm>
#include <cstddef>

namespace sonarsim {

namespace {

bool has_colours(const Image& image) {
    return image.channels > 2;
}

void require_alike(const Image& first, const Image& other, const Location& where) {
    const bool alike = has_colours(first) == has_colours(other) && first.bits == other.bits &&
                       first.is_float == other.is_float && first.channels <= 4 &&
                       other.channels <= 4;
    if (alike) return;
    throw InputError(where,
                     "has images of different kinds; give all of them colours of 8 bits, or all of "
                     "them one channel of numbers");
}

/// Copies an image into a larger one that has an alpha channel.
void copy_into(const Image& from, int first_column, Image& to) {
    const int values = to.channels - 1;
    const double opaque = from.is_float ? 1.0 : static_cast<double>((1LL << from.bits) - 1);
    for (int row = 0; row < from.height; ++row) {
        for (int column = 0; column < from.width; ++column) {
            const float* source = from.pixel(row, column);
            const auto at =
                to.values.begin() + (to.pixel(row, first_column + column) - to.values.data());
            std::copy_n(source, values, at);
            at[values] = from.channels > values ? source[values] : static_cast<float>(opaque);
        }
    }
}

}  // namespace

SideBySide side_by_side(const std::vector<Image>& images, const Location& where) {
    SideBySide out;
    Image& all = out.image;
    const Image& first = images.front();
    std::size_t width = 0;
    for (const Image& image : images) {
        require_alike(first, image, where);
        width += static_cast<std::size_t>(image.width);
        all.height = std::max(all.height, image.height);
    }
    all.channels = has_colours(first) ? 4 : 2;
    all.bits = first.bits;
    all.is_float = first.is_float;
    const auto height = static_cast<std::size_t>(all.height);
    const auto channels = static_cast<std::size_t>(all.channels);
    if (width > most_image_values / channels / height) {
        throw InputError(where,
                         "has images that are too large side by side, more than 2^26 values; make "
                         "them smaller");
    }
    all.width = static_cast<int>(width);
    all.values.assign(width * height * channels, 0.0F);
    int column = 0;
    for (const Image& image : images) {
        copy_into(image, column, all);
        const Eigen::Vector2d corner(1.0 * column / all.width, 0.0);
        const Eigen::Vector2d size(1.0 * image.width / all.width, 1.0 * image.height / all.height);
        out.places.emplace_back(corner, corner + size);
        column += image.width;
    }
    return out;
}

}  // namespace sonarsim
