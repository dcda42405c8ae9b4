#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gallery/sheet_module.h"
#include "guarded.h"

// Contact sheets through OpenImageIO, which scales the pictures, writes text with a TrueType font
// and knows the formats.

namespace {

using OIIO::ImageBuf;
using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::TypeDesc;
namespace Algo = OIIO::ImageBufAlgo;

constexpr int margin_px = 8;
constexpr int text_px = 14;
constexpr int line_px = 18;
constexpr float backdrop[] = {0.063F, 0.063F, 0.078F};
constexpr float ink[] = {0.92F, 0.92F, 0.92F};

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
    throw std::runtime_error(file + ": " + reason);
}

/// A picture in three channels of 8 bits.
ImageBuf read_picture(const std::string& file) {
    constexpr std::size_t most_values = std::size_t{1} << 28;
    // The content is read as the file's name says.
    const std::string extension = file.substr(file.rfind('.') + 1);
    const std::unique_ptr<ImageInput> input =
        ImageInput::create(extension == "jpg" || extension == "webp" ? extension : "png");
    if (!input) throw std::runtime_error(OIIO::geterror());
    ImageSpec spec;
    if (!input->open(file, spec)) fail(file, input->geterror());
    const auto values = static_cast<std::size_t>(spec.width) *
                        static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels);
    if (spec.width < 1 || spec.height < 1 || values > most_values)
        fail(file, "has no pixels, or more than 2^28 values");
    ImageBuf picture(ImageSpec(spec.width, spec.height, spec.nchannels, TypeDesc::UINT8));
    if (!input->read_image(0, 0, 0, spec.nchannels, TypeDesc::UINT8, picture.localpixels()))
        fail(file, input->geterror());
    const int last = spec.nchannels < 3 ? 0 : 2;
    const int order[] = {0, std::min(1, last), last};
    return Algo::channels(picture, 3, order);
}

/// The picture, made so small that it fits into a square.
ImageBuf thumbnail_of(const SonarsimThumbnail& from, int side) {
    ImageBuf picture = read_picture(from.file);
    if (from.turned != 0) picture = Algo::rotate180(picture);
    const int width = picture.spec().width;
    const int height = picture.spec().height;
    const int longest = std::max(width, height);
    if (longest <= side) return picture;
    const auto scaled = [&](int length) {
        const auto of_longest = static_cast<long long>(length) * side / longest;
        return std::max(1, static_cast<int>(of_longest));
    };
    ImageBuf small =
        Algo::resize(picture, "", 0.0F, ROI(0, scaled(width), 0, scaled(height), 0, 1, 0, 3));
    if (small.has_error()) fail(from.file, small.geterror());
    return small;
}

std::vector<std::string> lines_of(const char* caption) {
    std::vector<std::string> lines;
    std::istringstream text(caption);
    for (std::string line; std::getline(text, line);)
        lines.push_back(line);
    return lines;
}

struct Cell {
    ImageBuf picture;
    std::vector<std::string> lines;
};

/// The height of a row of cells and where their captions begin.
struct RowHeight {
    int pictures = 0;
    int all = 0;
};

RowHeight height_of(std::span<const Cell> row) {
    RowHeight height;
    int lines = 0;
    for (const Cell& cell : row) {
        height.pictures = std::max(height.pictures, cell.picture.spec().height);
        lines = std::max(lines, static_cast<int>(cell.lines.size()));
    }
    height.all = height.pictures + lines * line_px + 2 * margin_px;
    return height;
}

void draw_cell(const Cell& cell, const RowHeight& row, int left, int top, int width,
               const std::string& font, ImageBuf& sheet) {
    const ImageSpec& spec = cell.picture.spec();
    // Pictures stand on their captions.
    if (!Algo::paste(sheet, left + (width - spec.width) / 2, top + row.pictures - spec.height, 0, 0,
                     cell.picture))
        throw std::runtime_error(sheet.geterror());
    int baseline = top + row.pictures + line_px - 2;
    for (const std::string& line : cell.lines) {
        if (!Algo::render_text(sheet, left + width / 2, baseline, line, text_px, font, ink,
                               Algo::TextAlignX::Center, Algo::TextAlignY::Baseline))
            throw std::runtime_error(sheet.geterror());
        baseline += line_px;
    }
}

ImageBuf draw_sheet(std::span<const Cell> cells, std::size_t columns, const std::string& font) {
    int cell_width = 1;
    for (const Cell& cell : cells)
        cell_width = std::max(cell_width, cell.picture.spec().width);
    std::vector<RowHeight> rows;
    int height = margin_px;
    for (std::size_t first = 0; first < cells.size(); first += columns) {
        rows.push_back(height_of(cells.subspan(first, std::min(columns, cells.size() - first))));
        height += rows.back().all;
    }
    const int width = static_cast<int>(columns) * (cell_width + margin_px) + margin_px;
    ImageBuf sheet(ImageSpec(width, height, 3, TypeDesc::UINT8));
    Algo::fill(sheet, backdrop);
    int top = margin_px;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        for (std::size_t c = 0; c < columns && row * columns + c < cells.size(); ++c) {
            const int left = margin_px + static_cast<int>(c) * (cell_width + margin_px);
            draw_cell(cells[row * columns + c], rows[row], left, top, cell_width, font, sheet);
        }
        top += rows[row].all;
    }
    return sheet;
}

void write_sheet(const SonarsimSheet& wanted) {
    OIIO::attribute("threads", 1);
    std::vector<Cell> cells;
    cells.reserve(wanted.count);
    for (std::size_t k = 0; k < wanted.count; ++k) {
        const SonarsimThumbnail& one = wanted.thumbnails[k];
        cells.push_back(
            {thumbnail_of(one, static_cast<int>(wanted.side_px)), lines_of(one.caption)});
    }
    ImageBuf sheet = draw_sheet(cells, wanted.columns, wanted.font);
    const std::string format = wanted.format;
    if (format != "png") sheet.specmod().attribute("Compression", format + ":90");
    if (!sheet.write(wanted.out, TypeDesc::UINT8, format)) fail(wanted.out, sheet.geterror());
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int sonarsim_write_sheet_1(const SonarsimSheet* sheet,
                                                                     char* error,
                                                                     std::size_t error_size) {
    return guarded(error, error_size, [&] { write_sheet(*sheet); });
}
