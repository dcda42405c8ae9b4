#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "product/picture.h"

namespace sonarsim {

inline constexpr int label_px = 12;

/// A line of text, which is drawn after everything else.
struct PictureText {
    int x = 0;  ///< pixel of the end that `align` names
    int y = 0;  ///< pixel of the middle of a digit's height
    std::string text;
    Align align = Align::left;
    Rgb colour = ink;
    int size_px = label_px;
    bool outlined = false;  ///< with a dark outline
};

/// A picture whose texts are not drawn yet.
struct Drawing : Picture {
    using Picture::Picture;
    std::vector<PictureText> texts;
};

/// About the width of a text, pixels.
int estimated_width(std::string_view text, int size_px = label_px);

/// Draws the texts with OpenImageIO and the font of DejaVu. InputError if one of them is not
/// installed. std::runtime_error if OpenImageIO fails.
void draw_texts(Drawing& drawing);

}  // namespace sonarsim
