#include "preview/labels.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/module.h"
#include "format/text_font.h"
#include "preview/text_module.h"

namespace sonarsim {

int estimated_width(std::string_view text, int size_px) {
    // The mean width of a letter of the font, and more than that of a digit.
    constexpr int percent_of_size = 64;
    const auto signs = std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return static_cast<int>(signs) * size_px * percent_of_size / 100;
}

void draw_texts(Drawing& drawing) {
    const char* const font = text_font("preview");
    const auto write_texts = reinterpret_cast<SonarsimWriteTexts>(
        module_symbol(image_module, text_module_symbol, image_package));
    std::vector<SonarsimText> texts;
    texts.reserve(drawing.texts.size());
    for (const PictureText& one : drawing.texts) {
        texts.push_back({one.text.c_str(),
                         one.x,
                         one.y,
                         static_cast<std::int32_t>(one.align),
                         one.size_px,
                         {one.colour.r, one.colour.g, one.colour.b},
                         one.outlined ? std::uint8_t{1} : std::uint8_t{0}});
    }
    std::array<char, 400> error{};
    auto* const pixels = reinterpret_cast<std::uint8_t*>(drawing.pixels.data());
    if (write_texts(pixels, static_cast<std::uint32_t>(drawing.width),
                    static_cast<std::uint32_t>(drawing.height), texts.data(), texts.size(), font,
                    error.data(), error.size()) != 0)
        throw std::runtime_error(std::string("OpenImageIO writes no text: ") + error.data());
    drawing.texts.clear();
}

}  // namespace sonarsim
