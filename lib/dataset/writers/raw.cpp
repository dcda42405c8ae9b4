#include <algorithm>
#include <cstdint>
#include <memory>

#include "dataset/averaged_rows.h"
#include "dataset/writer.h"
#include "dataset/writers/strip_rows.h"
#include "format/png.h"
#include "product/scan.h"

namespace sonarsim {

namespace {

using Numbers = std::vector<std::uint16_t>;

/// Converts values of at most 8 bits to bytes.
std::vector<std::uint8_t> as_bytes(std::span<const std::uint16_t> values) {
    std::vector<std::uint8_t> bytes(values.size());
    std::ranges::transform(values, bytes.begin(),
                           [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
    return bytes;
}

/// Bytes of one of the instrument's values in a file.
int bytes_of(const EchoModel& model) {
    return model.info.raw_bits > 8 ? 2 : 1;
}

/// raw/NNNNNN.png: 8 or 16 bits [range, azimuth], the output of the calibrated model's instrument.
class RawWriter final : public Writer {
  public:
    explicit RawWriter(const WriterContext& context)
        : view_(context.sonar().settings.view),
          model_(*context.sonar().settings.model),
          bytes_(bytes_of(model_)) {}

    WriterOutputs outputs() const override {
        return {
            PingFile{.name = "raw", .extension = ".png", .array = PingArray::bins, .title = "raw"},
            png_bytes_at_most(view_.beams, view_.range_bins, bytes_),
            {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        const Numbers values = model_.raw(ping);
        if (bytes_ == 2) return png_bytes(values, ping.beams, ping.range_bins);
        return png_bytes(as_bytes(values), ping.beams, ping.range_bins);
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        Numbers values = model_.raw(ping);
        if (bytes_ == 1) return make_numbers(as_bytes(values), ping.range_bins, ping.beams);
        return make_numbers(std::move(values), ping.range_bins, ping.beams);
    }

  private:
    const View& view_;
    const EchoModel& model_;
    int bytes_;
};

/// raw.npy: 8 or 16 bits, the output of the calibrated model's instrument, in the shape of the
/// sonar's other records. raw.png is the same as a picture; a scanning sonar has a picture [range,
/// step] for each sweep, raw_0000.png and so on. Values of an instrument have no mean: where
/// several pings share a row of the picture, it shows the first of them.
class RawRecordsWriter final : public Writer {
  public:
    explicit RawRecordsWriter(const WriterContext& context)
        : context_(context),
          config_(context.sonar().config),
          model_(*context.sonar().settings.model),
          shape_(context.kind().record),
          bytes_(bytes_of(model_)),
          values_(shape_.values(config_)) {}

    WriterOutputs outputs() const override {
        WriterOutputs outputs =
            record_outputs(context_, "raw", bytes_ == 1 ? "|u1" : "<u2", bytes_, "raw");
        const auto values = static_cast<int>(values_);
        const int rows = picture_rows(context_.pings);
        if (shape_.pictures == RecordPictures::sweeps) {
            for (std::size_t sweep = 0; sweep < scan_sweeps(config_, context_.pings); ++sweep) {
                outputs.products.push_back(
                    {scan_file_name("raw", sweep, ".png"),
                     png_bytes_at_most(scan_steps(config_), values, bytes_)});
            }
        } else {
            outputs.products.push_back({"raw.png", shape_.upright
                                                       ? png_bytes_at_most(rows, values, bytes_)
                                                       : png_bytes_at_most(values, rows, bytes_)});
        }
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(*numbers(finished));
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        Numbers values =
            record_values<std::uint16_t>(shape_, config_, model_.raw(finished.ping), 0);
        if (bytes_ == 1) return make_numbers(as_bytes(values));
        return make_numbers(std::move(values));
    }

    void write_products(const RecordFile& records,
                        const std::filesystem::path& folder) const override {
        if (shape_.pictures == RecordPictures::sweeps) return write_sweeps(records, folder);
        const auto rows = static_cast<std::size_t>(picture_rows(context_.pings));
        ImageFile image = shape_.upright ? picture(folder / "raw.png", rows, values_)
                                         : picture(folder / "raw.png", values_, rows);
        for_each_strip_row<std::uint16_t>(
            rows, values_, shape_.upright,
            [&](std::size_t k) { return ping(records, k * pings_per_row(context_.pings)); },
            [&](std::span<const std::uint16_t> row) { append(image, row); });
        image.finish();
    }

  private:
    Numbers ping(const RecordFile& records, std::size_t k) const {
        Numbers values(values_);
        if (bytes_ == 2) {
            records.read(k, std::as_writable_bytes(std::span(values)));
            return values;
        }
        std::vector<std::uint8_t> bytes(values_);
        records.read(k, std::as_writable_bytes(std::span(bytes)));
        std::ranges::copy(bytes, values.begin());
        return values;
    }

    ImageFile picture(const std::filesystem::path& path, std::size_t width,
                      std::size_t height) const {
        return {path, static_cast<int>(width), static_cast<int>(height),
                bytes_ == 1 ? PixelKind::grey8 : PixelKind::grey16};
    }

    void append(ImageFile& image, std::span<const std::uint16_t> row) const {
        bytes_ == 1 ? image.row(as_bytes(row)) : image.row(row);
    }

    /// The display after each sweep of the head.
    void write_sweeps(const RecordFile& records, const std::filesystem::path& folder) const {
        const auto steps = static_cast<std::size_t>(scan_steps(config_));
        Numbers display(values_ * steps);
        for (std::size_t k = 0; k < context_.pings; ++k) {
            const Numbers values = ping(records, k);
            const auto step = static_cast<std::size_t>(scan_step(config_, k));
            for (std::size_t i = 0; i < values_; ++i)
                display[i * steps + step] = values[i];
            if ((k + 1) % steps != 0 && k + 1 != context_.pings) continue;
            ImageFile image =
                picture(folder / scan_file_name("raw", k / steps, ".png"), steps, values_);
            for (std::size_t i = 0; i < values_; ++i)
                append(image, std::span(display).subspan(i * steps, steps));
            image.finish();
        }
    }

    WriterContext context_;
    const SonarConfig& config_;
    const EchoModel& model_;
    const RecordShape& shape_;
    int bytes_;
    std::size_t values_;  ///< per ping
};

bool is_asked(const WriterContext& context) {
    return context.mission.output.raw && context.sonar().settings.model->info.raw_bits > 0;
}

}  // namespace

std::unique_ptr<Writer> make_raw_writer(const WriterContext& context) {
    if (!is_asked(context) || !context.kind().has_images) return nullptr;
    return std::make_unique<RawWriter>(context);
}

std::unique_ptr<Writer> make_raw_records_writer(const WriterContext& context) {
    if (!is_asked(context) || context.kind().has_images) return nullptr;
    return std::make_unique<RawRecordsWriter>(context);
}

}  // namespace sonarsim
