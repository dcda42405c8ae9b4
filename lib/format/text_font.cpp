#include "format/text_font.h"

#include <string>
#include <system_error>

#include "core/error.h"

namespace sonarsim {

const char* text_font(const std::filesystem::path& picture) {
    static constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    std::error_code ignored;
    if (!std::filesystem::exists(font, ignored)) {
        throw InputError({picture.string()},
                         "needs the font " + std::string(font) + "; install fonts-dejavu-core");
    }
    return font;
}

}  // namespace sonarsim
