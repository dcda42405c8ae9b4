#include <iterator>

#include "output/dataset/strip_rows.h"
#include "output/dataset/writer.h"
#include "simulate/product/contrast.h"

namespace sonarsim {

// Files for other programs, made of waterfall.npy: waterfall.xtf, mosaic.tif with mosaic.json.
std::vector<std::string> swath_products(const WriterContext& context);
void write_swath_files(const WriterContext& context, const RecordFile& rows,
                       const std::filesystem::path& folder);

namespace {

/// The float32 records of a file as the rows of a picture, each the mean of pings_per_row() pings.
class AveragedRows {
  public:
    explicit AveragedRows(const RecordFile& records)
        : records_(records),
          record_(records.record_bytes() / sizeof(float)),
          mean_(record_.size()) {}

    std::size_t rows() const { return static_cast<std::size_t>(picture_rows(records_.records())); }

    /// Row k; valid until the next call.
    const std::vector<float>& row(std::size_t k) {
        const std::size_t fold = pings_per_row(records_.records());
        const std::size_t first = k * fold;
        const std::size_t last = std::min(first + fold, records_.records());
        std::ranges::fill(mean_, 0.0F);
        for (std::size_t i = first; i < last; ++i) {
            records_.read(i, std::as_writable_bytes(std::span(record_)));
            for (std::size_t x = 0; x < mean_.size(); ++x)
                mean_[x] += record_[x];
        }
        for (float& value : mean_)
            value /= static_cast<float>(last - first);
        return mean_;
    }

    /// The intensity of the brightest colour in a picture for people.
    double white() {
        Gain gain;
        for (std::size_t k = 0; k < rows(); ++k)
            gain.add(row(k));
        return gain.white();
    }

  private:
    const RecordFile& records_;
    std::vector<float> record_, mean_;
};

std::string plain_name(const RecordShape& shape) {
    return std::string(shape.name) + ".png";
}
std::string view_name(const RecordShape& shape) {
    return std::string(shape.name) + "_view.png";
}

StripFrame frame_of(const WriterContext& context) {
    return context.kind().record.style.frame(context.sonar().config, picture_rows(context.pings));
}

void write_strip_products(const WriterContext& context, const RecordFile& file,
                          const std::filesystem::path& folder) {
    const RecordShape& shape = context.kind().record;
    AveragedRows records(file);
    const double white = records.white();
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
    if (shape.two_sides) write_swath_files(context, file, folder);
}

void describe_strip(const WriterContext& context, Json& sensor) {
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

/// The records of a sonar whose picture is a strip. NAME.npy: float32, a row or column per ping;
/// NAME.png: the same in 16 bits; NAME_view.png: as an operator sees it, with an axis of ranges.
Writer make_strip_writer(const WriterContext& context) {
    const RecordShape& shape = context.kind().record;
    const SonarConfig& config = context.sonar().config;
    std::vector<std::string> products{plain_name(shape), view_name(shape)};
    if (shape.two_sides) std::ranges::move(swath_products(context), std::back_inserter(products));
    return {
        .per_ping = record_of_kind(context, std::string(shape.name), "<f4"),
        .products = std::move(products),
        .encode =
            [&shape, &config](const FinishedPing& finished) {
                return record_bytes(record_values(shape, config, finished.ping.intensity, 0.0F));
            },
        .write_products = std::bind_front(write_strip_products, context),
        .describe = std::bind_front(describe_strip, context)};
}

}  // namespace sonarsim
