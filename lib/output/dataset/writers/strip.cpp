#include <algorithm>
#include <iterator>

#include "output/dataset/averaged_rows.h"
#include "output/dataset/writer.h"
#include "simulate/product/contrast.h"

namespace sonarsim {

// The files of a side-scan sonar for other programs that the mission asks for, made of
// waterfall.npy: waterfall.xtf, and mosaic.tif with mosaic.json.
std::vector<std::string> swath_products(const WriterContext& context);
void write_swath_files(const WriterContext& context, const RecordFile& rows,
                       const std::filesystem::path& folder);

namespace {

std::string plain_name(const RecordShape& shape) {
    return std::string(shape.name) + ".png";
}
std::string view_name(const RecordShape& shape) {
    return std::string(shape.name) + "_view.png";
}

StripFrame frame_of(const WriterContext& context) {
    return context.kind().record.style.frame(context.sonar().config, picture_rows(context.pings));
}

void write_pictures(const WriterContext& context, const RecordFile& file,
                    const std::filesystem::path& folder) {
    const RecordShape& shape = context.kind().record;
    AveragedRows records(file);
    const double white = white_of(records);
    const auto rows = static_cast<int>(records.rows());
    const auto values = static_cast<int>(shape.values(context.sonar().config));
    const StripFrame frame = frame_of(context);
    Picture axis = shape.style.axis(context.sonar().config, frame);
    ImageFile plain(folder / plain_name(shape), shape.upright ? rows : values,
                    shape.upright ? values : rows, PixelKind::grey16);
    ImageFile view(folder / view_name(shape), frame.width, frame.height, PixelKind::rgb8);
    int y = 0;
    for (; y < frame.axis_height; ++y)
        view.row(std::span<const Rgb>(axis.row(y), axis.width));
    std::vector<Rgb> pixels(frame.width);
    const auto draw = [&](std::span<const float> row) {
        plain.row(grey_16(row, context.full_scale()));
        shape.style.row(row, white, frame, std::span(pixels).subspan(frame.axis_width));
        for (int k = 0; k < (shape.upright ? frame.bin_px : frame.ping_px); ++k, ++y) {
            if (frame.axis_width > 0) std::copy_n(axis.row(y), frame.axis_width, pixels.begin());
            view.row(pixels);
        }
    };
    for_each_strip_row<float>(
        records.rows(), static_cast<std::size_t>(values), shape.upright,
        [&](std::size_t k) -> const std::vector<float>& { return records.row(k); }, draw);
    plain.finish();
    view.finish();
}

void describe_strip(const WriterContext& context, nlohmann::ordered_json& sensor) {
    const RecordShape& shape = context.kind().record;
    if (shape.describe) shape.describe(context.sonar(), sensor);
    const StripFrame frame = frame_of(context);
    const int across = shape.upright ? frame.ping_px : frame.bin_px;
    const int down = shape.upright ? frame.bin_px : frame.ping_px;
    const std::string folder = context.sonar().config.name + "/";
    sensor["pictures"].push_back({{"title", std::string(shape.name)},
                                  {"file", folder + view_name(shape)},
                                  {"per", "sensor"},
                                  {"boxes_of", folder + plain_name(shape)},
                                  {"origin_px", {frame.axis_width, frame.axis_height}},
                                  {"pixel_px", {across, down}},
                                  {"pings_along", shape.upright ? "x" : "y"},
                                  {"pings_per_pixel", pings_per_row(context.pings)}});
}

}  // namespace

/// The records of a sonar whose picture is a strip, such as a waterfall or an echogram. NAME.npy:
/// float32, a row or column per ping; NAME.png: the same in 16 bits; NAME_view.png: as an operator
/// sees it, with an axis of ranges.
std::optional<Writer> make_strip_writer(const WriterContext& context) {
    const RecordShape& shape = context.kind().record;
    if (shape.pictures != RecordPictures::strip) return std::nullopt;
    const SonarConfig& config = context.sonar().config;
    std::vector<std::string> products{plain_name(shape), view_name(shape)};
    if (shape.two_sides) std::ranges::move(swath_products(context), std::back_inserter(products));
    return Writer{
        .per_ping = record_of_kind(context, std::string(shape.name), "<f4"),
        .products = std::move(products),
        .encode =
            [&shape, &config](const FinishedPing& finished) {
                return record_bytes(record_values(shape, config, finished.ping.intensity, 0.0F));
            },
        .write_products =
            [context](const RecordFile& file, const std::filesystem::path& folder) {
                write_pictures(context, file, folder);
                if (context.kind().record.two_sides) write_swath_files(context, file, folder);
            },
        .describe = [context](nlohmann::ordered_json& s) { describe_strip(context, s); }};
}

}  // namespace sonarsim
