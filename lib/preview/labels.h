#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "product/picture.h"

namespace sonarsim {

/// A line of text, which is drawn after everything else.
struct PictureText {
    int x = 0;  ///< pixel of the end that `align` names
    int y = 0;  ///< pixel of the middle of its height
    std::string text;
    Align align = Align::left;
    Rgb colour = ink;
    bool outlined = false;  ///< with a dark outline
};

/// A picture whose texts are not drawn yet.
struct Drawing : Picture {
    using Picture::Picture;
    std::vector<PictureText> texts;
};

/// Draws the texts in the letters of write().
void draw_texts(Drawing& drawing);

}  // namespace sonarsim
