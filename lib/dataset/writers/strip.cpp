#include <algorithm>

#include "dataset/folded_records.h"
#include "dataset/writer.h"
#include "dataset/writers/strip_rows.h"
#include "dataset/writers/swath_files.h"
#include "format/png.h"
#include "product/gain.h"

namespace sonarsim {

namespace {

/// The records of a sonar whose picture is a strip, such as a waterfall or an echogram. NAME.npy:
/// float32, a row or column per ping; NAME.png: the same in 16 bits; NAME_view.png: as an operator
/// sees it, with an axis of ranges.
class StripWriter final : public Writer {
  public:
    explicit StripWriter(const WriterContext& context)
        : context_(context),
          shape_(context.kind().record),
          name_(shape_.name),
          config_(context.sonar().config),
          values_(shape_.values(config_)) {}

    WriterOutputs outputs() const override {
        const int rows = picture_rows(context_.pings);
        const auto values = static_cast<int>(values_);
        const StripFrame frame = shape_.style.frame(config_, rows);
        WriterOutputs outputs = record_outputs(context_, name_, "<f4", 4);
        outputs.products = {{plain_name(), shape_.upright ? png_bytes_at_most(rows, values, 2)
                                                          : png_bytes_at_most(values, rows, 2)},
                            {view_name(), png_bytes_at_most(frame.width, frame.height, 3)}};
        if (!shape_.two_sides) return outputs;
        for (Product& product : swath_products(context_))
            outputs.products.push_back(std::move(product));
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(record_values(shape_, config_, finished.ping.intensity, 0.0F));
    }

    void write_products(const RecordFile& file,
                        const std::filesystem::path& folder) const override {
        FoldedRecords records(file);
        const double white = white_of(records);
        const auto rows = static_cast<int>(records.rows());
        const auto values = static_cast<int>(values_);
        const StripFrame frame = shape_.style.frame(config_, rows);
        Picture axis = shape_.style.axis(config_, frame);
        ImageFile plain(folder / plain_name(), shape_.upright ? rows : values,
                        shape_.upright ? values : rows, PixelKind::grey16);
        ImageFile view(folder / view_name(), frame.width, frame.height, PixelKind::rgb8);
        int y = 0;
        for (; y < frame.axis_height; ++y)
            view.row(std::span<const Rgb>(axis.row(y), axis.width));
        std::vector<Rgb> pixels(frame.width);
        const auto draw = [&](std::span<const float> row) {
            plain.row(grey_16(row, context_.full_scale()));
            shape_.style.row(row, white, frame, std::span(pixels).subspan(frame.axis_width));
            for (int k = 0; k < (shape_.upright ? frame.bin_px : frame.ping_px); ++k, ++y) {
                if (frame.axis_width > 0)
                    std::copy_n(axis.row(y), frame.axis_width, pixels.begin());
                view.row(pixels);
            }
        };
        for_each_strip_row<float>(
            records.rows(), values_, shape_.upright,
            [&](std::size_t k) -> const std::vector<float>& { return records.row(k); }, draw);
        plain.finish();
        view.finish();
        if (shape_.two_sides) write_swath_files(context_, file, folder);
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        if (shape_.describe) shape_.describe(context_.sonar(), sensor);
        const StripFrame frame = shape_.style.frame(config_, picture_rows(context_.pings));
        const int across = shape_.upright ? frame.ping_px : frame.bin_px;
        const int down = shape_.upright ? frame.bin_px : frame.ping_px;
        const std::string folder = config_.name + "/";
        sensor["pictures"].push_back({{"title", name_},
                                      {"file", folder + view_name()},
                                      {"per", "sensor"},
                                      {"boxes_of", folder + plain_name()},
                                      {"origin_px", {frame.axis_width, frame.axis_height}},
                                      {"pixel_px", {across, down}},
                                      {"pings_along", shape_.upright ? "x" : "y"},
                                      {"pings_per_pixel", pings_per_row(context_.pings)}});
    }

  private:
    std::string plain_name() const { return name_ + ".png"; }
    std::string view_name() const { return name_ + "_view.png"; }

    WriterContext context_;
    const RecordShape& shape_;
    std::string name_;
    const SonarConfig& config_;
    std::size_t values_;  ///< per ping
};

}  // namespace

std::unique_ptr<Writer> make_strip_writer(const WriterContext& context) {
    const RecordShape& shape = context.kind().record;
    if (shape.pictures != RecordPictures::strip) return nullptr;
    if (!shape.is_written(context.mission.output)) return nullptr;
    return std::make_unique<StripWriter>(context);
}

}  // namespace sonarsim
