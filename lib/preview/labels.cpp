#include "preview/labels.h"

#include <cctype>

namespace sonarsim {

namespace {

/// The text with a capital M within words: write() draws a small m as the sign of metres.
std::string with_capitals(std::string text) {
    const auto is_letter = [&](std::size_t k) {
        return k < text.size() &&
               (text[k] == '_' || std::isalpha(static_cast<unsigned char>(text[k])));
    };
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == 'm' && (is_letter(k + 1) || (k > 0 && is_letter(k - 1)))) text[k] = 'M';
    }
    return text;
}

}  // namespace

void draw_texts(Drawing& drawing) {
    constexpr int half_height = 3;
    for (const PictureText& one : drawing.texts) {
        const int y = one.y - half_height;
        const std::string text = with_capitals(one.text);
        for (int j = -1; j <= 1 && one.outlined; ++j) {
            for (int i = -1; i <= 1; ++i)
                write(drawing, one.x + i, y + j, text, one.align, backdrop);
        }
        write(drawing, one.x, y, text, one.align, one.colour);
    }
    drawing.texts.clear();
}

}  // namespace sonarsim
