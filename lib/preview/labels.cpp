#include "preview/labels.h"

namespace sonarsim {

void draw_texts(Drawing& drawing) {
    constexpr int half_height = 3;
    for (const PictureText& one : drawing.texts) {
        const int y = one.y - half_height;
        for (int j = -1; j <= 1 && one.outlined; ++j) {
            for (int i = -1; i <= 1; ++i)
                write(drawing, one.x + i, y + j, one.text, one.align, backdrop);
        }
        write(drawing, one.x, y, one.text, one.align, one.colour);
    }
    drawing.texts.clear();
}

}  // namespace sonarsim
