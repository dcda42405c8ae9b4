#include "product/waterfall.h"

#include "dataset/folded_records.h"
#include "dataset/writers/formats.h"
#include "dataset/writers/swath_files.h"
#include "format/image_file.h"
#include "format/png.h"
#include "product/grey.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

/// waterfall.npy: float32 [ping, column], both sides from nadir on; waterfall.png the same in 16
/// bits, waterfall_view.png in copper tones.
class WaterfallWriter final : public Writer {
  public:
    explicit WaterfallWriter(const WriterContext& context)
        : context_(context),
          sonar_(context.sonar()),
          pings_(context.pings),
          full_scale_(context.full_scale()) {}

    WriterOutputs outputs() const override {
        const auto columns = static_cast<std::size_t>(waterfall_columns(sonar_.config));
        const Picture axis = waterfall_axis(sonar_.config);
        const int rows = picture_rows(pings_);
        WriterOutputs outputs = record_outputs(
            "waterfall.npy", {"<f4", {pings_, columns}},
            {"ping", "port from range_max to nadir, then starboard from nadir to range_max"},
            4.0 * static_cast<double>(columns));
        outputs.products = {
            {"waterfall.png", png_bytes_at_most(static_cast<int>(columns), rows, 2)},
            {"waterfall_view.png", png_bytes_at_most(axis.width, axis.height + rows, 3)}};
        for (Product& product : swath_products(context_))
            outputs.products.push_back(std::move(product));
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(sidescan_row(sonar_.config, finished.ping));
    }

    void write_products(const RecordFile& file,
                        const std::filesystem::path& folder) const override {
        FoldedRecords records(file);
        const double white = white_of(records);
        Picture axis = waterfall_axis(sonar_.config);
        const int rows = static_cast<int>(records.rows());
        ImageFile plain(folder / "waterfall.png", waterfall_columns(sonar_.config), rows,
                        PixelKind::grey16);
        ImageFile view(folder / "waterfall_view.png", axis.width, axis.height + rows,
                       PixelKind::rgb8);
        for (int y = 0; y < axis.height; ++y)
            view.row(std::span<const Rgb>(axis.row(y), axis.width));
        std::vector<Rgb> pixels(axis.width);
        for (int k = 0; k < rows; ++k) {
            const std::vector<float>& row = records.row(k);
            plain.row(grey_16(row, full_scale_));
            waterfall_row(row, white, pixels);
            view.row(pixels);
        }
        plain.finish();
        view.finish();
        write_swath_files(context_, file, folder);
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        sensor["waterfall"] = {{"columns", waterfall_columns(sonar_.config)},
                               {"blank_columns_a_side", blank_columns(sonar_.config)},
                               {"column_m", sonar_.settings.view.bin_m()},
                               {"slant_range",
                                "of the middle of column k: |k + 0.5 - columns / 2| "
                                "column_m; blank columns lie before range_min"}};
    }

  private:
    WriterContext context_;
    const Sonar& sonar_;
    std::size_t pings_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_waterfall_writer(const WriterContext& context) {
    const bool records = context.kind().record == RecordKind::waterfall;
    if (!context.mission.output.waterfall || !records) return nullptr;
    return std::make_unique<WaterfallWriter>(context);
}

}  // namespace sonarsim
