#include <algorithm>
#include <cstring>
#include <limits>

#include "dataset/folded_records.h"
#include "dataset/writers/formats.h"
#include "dataset/writers/raw_values.h"
#include "format/image_file.h"
#include "format/png.h"
#include "product/scan.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

/// What is held of the records at a time while they are turned on their side.
constexpr std::size_t most_values = std::size_t{1} << 24;

/// raw.npy: 8 or 16 bits, what the instrument of the calibrated model delivers, in the shape of the
/// sonar's other records, whose pings it lists; raw.png is the same as a picture, of a scanning
/// sonar raw_0000.png and so on, [range, step], a picture for every sweep. Numbers of an instrument
/// have no mean: where several pings share a row of the picture, the first of them is shown.
class RawRecordsWriter final : public Writer {
  public:
    explicit RawRecordsWriter(const WriterContext& context)
        : config_(context.sonar().config),
          model_(*context.sonar().settings.model),
          record_(context.kind().record),
          pings_(context.pings),
          bytes_(raw_bytes(model_.raw_bits())),
          values_(record_ == RecordKind::waterfall ? waterfall_columns(config_)
                                                   : config_.range_bins) {}

    WriterOutputs outputs() const override {
        const std::string type = bytes_ == 1 ? "|u1" : "<u2";
        const bool upright = record_ == RecordKind::echogram;
        NpyFormat format{type, {pings_, values_}};
        if (upright) format = {type, {values_, pings_}, true};
        nlohmann::ordered_json axes = {
            "ping", record_ == RecordKind::waterfall ? "column, as in waterfall.npy" : "range"};
        if (upright) axes = {"range", "ping"};
        WriterOutputs outputs = record_outputs("raw.npy", std::move(format), std::move(axes),
                                               static_cast<double>(bytes_ * values_));
        std::get<PingRecord>(outputs.per_ping).label = "raw";
        const int width = static_cast<int>(values_);
        if (record_ == RecordKind::scan) {
            for (std::size_t sweep = 0; sweep < scan_sweeps(config_, pings_); ++sweep) {
                outputs.products.push_back({scan_file_name("raw", sweep, ".png"),
                                            png_bytes_at_most(scan_steps(config_), width, bytes_)});
            }
        } else {
            const int rows = picture_rows(pings_);
            outputs.products.push_back({"raw.png", upright
                                                       ? png_bytes_at_most(rows, width, bytes_)
                                                       : png_bytes_at_most(width, rows, bytes_)});
        }
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        const std::vector<std::uint16_t> values = model_.raw(finished.ping);
        if (record_ != RecordKind::waterfall) return packed(values);
        return packed(sidescan_row<std::uint16_t>(config_, values, 0));
    }

    void write_products(const RecordFile& records,
                        const std::filesystem::path& folder) const override {
        if (record_ == RecordKind::scan) {
            write_sweeps(records, folder);
        } else if (record_ == RecordKind::echogram) {
            write_on_its_side(records, folder / "raw.png");
        } else {
            write_rows(records, folder / "raw.png");
        }
    }

  private:
    std::string packed(const std::vector<std::uint16_t>& values) const {
        return bytes_ == 1 ? record_bytes(as_bytes(values)) : record_bytes(values);
    }

    std::vector<std::uint16_t> ping(const RecordFile& records, std::size_t k) const {
        std::vector<std::uint16_t> values(values_);
        if (bytes_ == 2) {
            records.read(k, std::as_writable_bytes(std::span(values)));
            return values;
        }
        std::vector<std::uint8_t> bytes(values_);
        records.read(k, std::as_writable_bytes(std::span(bytes)));
        std::ranges::copy(bytes, values.begin());
        return values;
    }

    PixelKind kind() const { return bytes_ == 1 ? PixelKind::grey8 : PixelKind::grey16; }

    void append(ImageFile& image, const std::vector<std::uint16_t>& row) const {
        if (bytes_ == 1) {
            image.row(as_bytes(row));
        } else {
            image.row(row);
        }
    }

    void write_rows(const RecordFile& records, const std::filesystem::path& path) const {
        const int rows = picture_rows(pings_);
        ImageFile image(path, static_cast<int>(values_), rows, kind());
        for (int k = 0; k < rows; ++k)
            append(image, ping(records, k * pings_per_row(pings_)));
        image.finish();
    }

    /// A row for every range bin, some of them at a time.
    void write_on_its_side(const RecordFile& records, const std::filesystem::path& path) const {
        const auto columns = static_cast<std::size_t>(picture_rows(pings_));
        ImageFile image(path, static_cast<int>(columns), static_cast<int>(values_), kind());
        const std::size_t at_once = std::clamp<std::size_t>(most_values / columns, 1, values_);
        std::vector<std::vector<std::uint16_t>> rows(at_once, std::vector<std::uint16_t>(columns));
        for (std::size_t first = 0; first < values_; first += at_once) {
            const std::size_t count = std::min(at_once, values_ - first);
            for (std::size_t k = 0; k < columns; ++k) {
                const std::vector<std::uint16_t> values = ping(records, k * pings_per_row(pings_));
                for (std::size_t i = 0; i < count; ++i)
                    rows[i][k] = values[first + i];
            }
            for (std::size_t i = 0; i < count; ++i)
                append(image, rows[i]);
        }
        image.finish();
    }

    /// The display as it stood after each sweep of the head.
    void write_sweeps(const RecordFile& records, const std::filesystem::path& folder) const {
        const auto steps = static_cast<std::size_t>(scan_steps(config_));
        std::vector<std::vector<std::uint16_t>> rows(values_, std::vector<std::uint16_t>(steps));
        for (std::size_t k = 0; k < pings_; ++k) {
            const std::vector<std::uint16_t> values = ping(records, k);
            const auto step = static_cast<std::size_t>(scan_step(config_, k));
            for (std::size_t i = 0; i < values_; ++i)
                rows[i][step] = values[i];
            if ((k + 1) % steps != 0 && k + 1 != pings_) continue;
            ImageFile image(folder / scan_file_name("raw", k / steps, ".png"),
                            static_cast<int>(steps), static_cast<int>(values_), kind());
            for (const std::vector<std::uint16_t>& row : rows)
                append(image, row);
            image.finish();
        }
    }

    const SonarConfig& config_;
    const EchoModel& model_;
    RecordKind record_;
    std::size_t pings_;
    int bytes_;
    std::size_t values_;  ///< of a ping
};

}  // namespace

std::unique_ptr<Writer> make_raw_records_writer(const WriterContext& context) {
    if (!context.mission.output.raw || context.kind().has_images) return nullptr;
    if (context.sonar().settings.model->raw_bits() == 0) return nullptr;
    return std::make_unique<RawRecordsWriter>(context);
}

}  // namespace sonarsim
