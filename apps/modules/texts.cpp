#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "guarded.h"
#include "preview/text_module.h"

// Texts in pictures through OpenImageIO.

namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
namespace Algo = OIIO::ImageBufAlgo;

/// Letters of one size. The degree sign is a small raised "o", since OpenImageIO 2.4 draws other
/// signs for those beyond ASCII.
struct Piece {
    std::string letters;
    bool is_degree = false;
};

std::vector<Piece> pieces_of(std::string_view text) {
    constexpr std::string_view degree = "\xC2\xB0";
    std::vector<Piece> pieces{{}};
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        if (text.substr(k, 2) == degree) {
            pieces.push_back({"o", true});
            pieces.push_back({});
            ++k;
        } else if (byte < 0x80) {
            pieces.back().letters += byte < 0x20 ? ' ' : text[k];
        } else if (byte >= 0xC0) {  // the first byte of another sign
            pieces.back().letters += '?';
        }
    }
    return pieces;
}

int size_of(const Piece& piece, int size_px) {
    return piece.is_degree ? size_px * 6 / 10 : size_px;
}

/// The advance width of the letters, px. Unlike the size of an image of the text, it includes
/// blanks at the ends.
int width_of(const Piece& piece, int size_px, const std::string& font) {
    const auto width = [&](const std::string& letters) {
        return Algo::text_size(letters, size_of(piece, size_px), font).width();
    };
    return piece.letters.empty() ? 0 : width("|" + piece.letters + "|") - width("||");
}

void write_one(const SonarsimText& text, const std::string& font, ImageBuf& picture) {
    const std::vector<Piece> pieces = pieces_of(text.text);
    int width = 0;
    for (const Piece& piece : pieces)
        width += width_of(piece, text.size_px, font);
    int x = text.x - width * text.align / 2;
    // A digit of this font is 0.73 of its size high.
    const int baseline = text.y + (text.size_px * 73 + 100) / 200;
    const float colour[] = {static_cast<float>(text.colour[0]) / 255.0F,
                            static_cast<float>(text.colour[1]) / 255.0F,
                            static_cast<float>(text.colour[2]) / 255.0F};
    for (const Piece& piece : pieces) {
        // The font's "o" is 0.33 of the size high and ends where the digits do.
        const int raised = piece.is_degree ? text.size_px * 40 / 100 : 0;
        if (!piece.letters.empty() &&
            !Algo::render_text(picture, x, baseline - raised, piece.letters,
                               size_of(piece, text.size_px), font, colour, Algo::TextAlignX::Left,
                               Algo::TextAlignY::Baseline, text.outlined != 0 ? 1 : 0))
            throw std::runtime_error(picture.geterror());
        x += width_of(piece, text.size_px, font);
    }
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_write_texts_1(
    std::uint8_t* pixels, std::uint32_t width, std::uint32_t height, const SonarsimText* texts,
    std::size_t count, const char* font, char* error, std::size_t error_size) {
    return guarded(error, error_size, [&] {
        OIIO::attribute("threads", 1);
        ImageBuf picture(
            ImageSpec(static_cast<int>(width), static_cast<int>(height), 3, TypeDesc::UINT8),
            pixels);
        for (const SonarsimText& text : std::span(texts, count))
            write_one(text, font, picture);
    });
}
