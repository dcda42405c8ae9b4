#include "product/echogram.h"

#include <algorithm>

#include "dataset/folded_records.h"
#include "dataset/writers/formats.h"
#include "format/image_file.h"
#include "format/png.h"
#include "product/grey.h"

namespace sonarsim {

namespace {

/// What is held of the records at a time while they are turned on their side.
constexpr std::size_t block_values = std::size_t{1} << 24;

/// Range bins [first, first + count) over all pings: [count, pings].
std::vector<float> across_pings(FoldedRecords& records, std::size_t first, std::size_t count) {
    const std::size_t pings = records.rows();
    std::vector<float> block(count * pings);
    for (std::size_t k = 0; k < pings; ++k) {
        const std::vector<float>& ping = records.row(k);
        for (std::size_t i = 0; i < count; ++i)
            block[i * pings + k] = ping[first + i];
    }
    return block;
}

/// echogram.npy: float32 [range, ping], in Fortran order, so that a ping lies together;
/// echogram.png the same in 16 bits, echogram_view.png with a depth axis.
class EchogramWriter final : public Writer {
  public:
    explicit EchogramWriter(const WriterContext& context)
        : config_(context.sonar().config),
          pings_(context.pings),
          full_scale_(context.full_scale()) {}

    WriterOutputs outputs() const override {
        const auto bins = static_cast<std::size_t>(config_.range_bins);
        const int columns = picture_rows(pings_);
        const EchogramFrame frame = echogram_frame(config_, columns);
        WriterOutputs outputs = record_outputs("echogram.npy", {"<f4", {bins, pings_}, true},
                                               {"range", "ping"}, 4.0 * static_cast<double>(bins));
        outputs.products = {{"echogram.png", png_bytes_at_most(columns, config_.range_bins, 2)},
                            {"echogram_view.png", png_bytes_at_most(frame.width, frame.height, 3)}};
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(finished.ping.intensity);
    }

    void write_products(const RecordFile& file,
                        const std::filesystem::path& folder) const override {
        FoldedRecords records(file);
        const double white = white_of(records);
        const std::size_t pings = records.rows();
        const auto bins = static_cast<std::size_t>(config_.range_bins);
        const EchogramFrame frame = echogram_frame(config_, static_cast<int>(pings));
        Picture axis = echogram_axis(config_, frame);
        ImageFile plain(folder / "echogram.png", static_cast<int>(pings), config_.range_bins,
                        PixelKind::grey16);
        ImageFile view(folder / "echogram_view.png", frame.width, frame.height, PixelKind::rgb8);
        std::vector<Rgb> pixels(frame.width);
        const std::size_t at_once = std::clamp<std::size_t>(block_values / pings, 1, bins);
        int y = 0;
        for (std::size_t first = 0; first < bins; first += at_once) {
            const std::size_t count = std::min(at_once, bins - first);
            const std::vector<float> block = across_pings(records, first, count);
            for (std::size_t i = 0; i < count; ++i) {
                const std::span<const float> row = std::span(block).subspan(i * pings, pings);
                plain.row(grey_16(row, full_scale_));
                echogram_row(row, white, frame.ping_width,
                             std::span(pixels).subspan(frame.axis_width));
                for (int k = 0; k < frame.range_height; ++k, ++y) {
                    std::copy_n(axis.row(y), frame.axis_width, pixels.begin());
                    view.row(pixels);
                }
            }
        }
        plain.finish();
        view.finish();
    }

  private:
    const SonarConfig& config_;
    std::size_t pings_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_echogram_writer(const WriterContext& context) {
    const bool records = context.kind().record == RecordKind::echogram;
    if (!context.mission.output.echogram || !records) return nullptr;
    return std::make_unique<EchogramWriter>(context);
}

}  // namespace sonarsim
