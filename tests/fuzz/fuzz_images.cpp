#include <cmath>

#include "input/scene/images/read_image.h"
#include "target.h"

// Any bytes as an image and as the world file next to it, read with the limits of a mission: as
// many values as the image states and a grid of finite numbers.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace sonarsim;
    const std::string_view bytes = text_of(data, size);
    write_input("x.tfw", bytes.substr(bytes.size() / 2));
    return read_or_refuse([&] {
        const Image image = read_image(write_input("x.tif", bytes));
        const std::size_t stated = static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height) *
                                   static_cast<std::size_t>(image.channels);
        require(stated > 0 && stated <= max_image_values && image.values.size() == stated);
        require(!image.grid || (std::isfinite(image.grid->x_m) && image.grid->column_m != 0.0));
    });
}
