#include "export/tiles.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace sonarsim {

namespace {

/// The part of an object on one side of a picture's nadir.
struct ObjectOnSide {
    SourceObject object;
    int from = 0, to = 0;  ///< columns of the side
};

std::vector<ObjectOnSide> on_sides(const SourcePicture& source,
                                   const std::vector<SourceObject>& objects) {
    std::vector<int> borders{0, source.width};
    if (source.nadir) borders.insert(borders.begin() + 1, *source.nadir);
    std::vector<ObjectOnSide> sided;
    for (const SourceObject& object : objects) {
        if (object.class_number == 0) continue;
        for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
            const ObjectMask part =
                cut_mask(object.mask, source.height, {0, source.width, 0, source.height},
                         borders[k], borders[k + 1]);
            if (part.area == 0) continue;
            ObjectOnSide& one =
                sided.emplace_back(ObjectOnSide{object, borders[k], borders[k + 1]});
            one.object.mask = part;
        }
    }
    return sided;
}

/// The part of the pings in a frame; `none` if they are not in one part.
SplitPart part_of_frame(const SourcePicture& source, const Frame& frame) {
    if (source.kind != SourcePicture::Kind::strip) return source.parts.front();
    const auto begin = source.parts.begin() + (source.rows_are_pings ? frame.top : frame.left);
    const auto end = source.parts.begin() + (source.rows_are_pings ? frame.bottom : frame.right);
    return std::all_of(begin, end, [&](SplitPart part) { return part == *begin; })
               ? *begin
               : SplitPart::none;
}

std::vector<SourceObject> objects_in(const SourcePicture& source,
                                     const std::vector<ObjectOnSide>& sided, const Frame& frame,
                                     const ExportOptions& options, LeftOut& left_out) {
    // A map of classes has pixels of objects of any size.
    const bool is_map = options.kind == ExportKind::masks;
    const bool has_crowds = is_map || options.kind == ExportKind::coco;
    const double least_share = is_map ? 0.0 : options.least_share;
    const int least = options.least_pixels > 0 ? options.least_pixels : source.min_pixels;
    const auto least_pixels = static_cast<std::uint64_t>(is_map ? 1 : least);
    std::vector<SourceObject> objects;
    for (const ObjectOnSide& one : sided) {
        const ObjectMask& whole = one.object.mask;
        const bool meets = whole.left < frame.right && whole.right > frame.left &&
                           whole.top < frame.bottom && whole.bottom > frame.top;
        if (!meets || (one.object.is_crowd && !has_crowds)) continue;
        const ObjectMask piece = cut_mask(whole, source.height, frame, one.from, one.to);
        if (piece.area == 0) continue;
        const bool is_small =
            static_cast<double>(piece.area) < least_share * static_cast<double>(whole.area);
        SourceObject object = one.object;
        object.mask = piece;
        if (const auto whole_shadow = object.seen.shadow)
            object.seen.shadow = cut_box(*whole_shadow, frame, one.from, one.to);
        const auto box = annotation_box(box_of(piece), object.seen.shadow, source.box);
        const bool is_tiny = piece.area < least_pixels && !object.is_crowd;
        if (is_small || is_tiny || (!box && !is_map)) {
            ++left_out.pieces;
            continue;
        }
        object.box = box.value_or(box_of(piece));
        objects.push_back(std::move(object));
    }
    return objects;
}

std::vector<Frame> frames_of(const SourcePicture& source, const ExportOptions& options) {
    const bool is_tiled = options.tile_px > 0 && source.kind != SourcePicture::Kind::ping;
    if (!is_tiled) return {{0, source.width, 0, source.height}};
    std::vector<Frame> frames;
    for (const int top : tile_begins(source.height, options.tile_px, options.overlap_px)) {
        for (const int left : tile_begins(source.width, options.tile_px, options.overlap_px)) {
            frames.push_back({left, std::min(left + options.tile_px, source.width), top,
                              std::min(top + options.tile_px, source.height)});
        }
    }
    return frames;
}

}  // namespace

void for_each_exported(const SourcePicture& source, const std::vector<SourceObject>& objects,
                       PixelReader& reader, const ExportOptions& options, LeftOut& left_out,
                       const std::function<void(const ExportedPicture&)>& visit) {
    const std::vector<Frame> frames = frames_of(source, options);
    const std::vector<ObjectOnSide> sided = on_sides(source, objects);
    std::string bytes = reader.file(source);
    const Pixels pixels = reader.read(source, bytes);
    for (const Frame& frame : frames) {
        ExportedPicture picture;
        picture.part = part_of_frame(source, frame);
        if (picture.part == SplitPart::none) {
            ++left_out.pictures;
            continue;
        }
        picture.name = source.name;
        if (frames.size() > 1) picture.name += fmt::format("-y{:05}-x{:05}", frame.top, frame.left);
        picture.width = frame.width();
        picture.height = frame.height();
        picture.objects = objects_in(source, sided, frame, options, left_out);
        const bool is_file = frames.size() == 1 && !pixels.is_changed;
        picture.png = is_file ? std::move(bytes) : png_of(pixels, frame);
        if (is_file && source.member.empty()) picture.original = source.file;
        visit(picture);
    }
}

}  // namespace sonarsim
