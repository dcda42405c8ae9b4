#include <cstdint>

#include "output/dataset/strip_rows.h"
#include "output/dataset/writer.h"
#include "simulate/product/scan.h"

namespace sonarsim {

namespace {

/// Bytes of a value that the instrument of the calibrated model delivers; 0 if the mission or the
/// model has none.
int raw_bytes(const WriterContext& context) {
    const int bits = context.sonar().settings.model->info.raw_bits;
    if (!context.mission.output.raw || bits == 0) return 0;
    return bits > 8 ? 2 : 1;
}

/// Values of an instrument, as bytes if they have one byte each.
PingNumbers raw_numbers(std::vector<std::uint16_t> values, int bytes,
                        std::vector<std::size_t> shape) {
    if (bytes == 2) return {std::move(values), std::move(shape)};
    return {std::vector<std::uint8_t>(values.begin(), values.end()), std::move(shape)};
}

/// Makes the pictures of raw.npy, whose numbers are of type T.
template <class T>
void write_raw_pictures(const WriterContext& context, const RecordFile& records,
                        const std::filesystem::path& folder) {
    constexpr PixelKind kind = sizeof(T) == 1 ? PixelKind::grey8 : PixelKind::grey16;
    const RecordShape& shape = context.kind().record;
    const SonarConfig& config = context.sonar().config;
    const std::size_t values = shape.values(config);
    std::vector<T> ping(values);
    const auto read = [&](std::size_t k) -> const std::vector<T>& {
        records.read(k, std::as_writable_bytes(std::span(ping)));
        return ping;
    };
    if (shape.pictures == RecordPictures::sweeps) {
        const auto steps = static_cast<std::size_t>(scan_steps(config));
        std::vector<T> display(values * steps);
        for_each_sweep(
            config, context.pings,
            [&](std::size_t k, int step) {
                read(k);
                for (std::size_t i = 0; i < values; ++i)
                    display[i * steps + static_cast<std::size_t>(step)] = ping[i];
            },
            [&](std::size_t sweep, std::size_t) {
                ImageFile image(folder / scan_file_name("raw", sweep, ".png"),
                                static_cast<int>(steps), static_cast<int>(values), kind);
                for (std::size_t i = 0; i < values; ++i)
                    image.row(std::span<const T>(display).subspan(i * steps, steps));
                image.finish();
            });
        return;
    }
    const int rows = picture_rows(context.pings);
    const auto across = static_cast<int>(values);
    ImageFile image(folder / "raw.png", shape.upright ? rows : across,
                    shape.upright ? across : rows, kind);
    for_each_strip_row<T>(
        static_cast<std::size_t>(rows), values, shape.upright,
        [&](std::size_t k) -> const std::vector<T>& {
            return read(k * pings_per_row(context.pings));
        },
        [&](std::span<const T> row) { image.row(row); });
    image.finish();
}

}  // namespace

/// raw/NNNNNN.png: 8 or 16 bits [range, azimuth], the output of the calibrated model's instrument.
std::optional<Writer> make_raw_writer(const WriterContext& context) {
    const int bytes = raw_bytes(context);
    if (bytes == 0 || !context.kind().has_images) return std::nullopt;
    const View& view = context.sonar().settings.view;
    return array_writer(
        PingFile{"raw", ".png", PingArray::bins, {}, "raw"},
        [bytes, &view, &model = *context.sonar().settings.model](const FinishedPing& finished) {
            return raw_numbers(
                model.raw(finished.ping), bytes,
                {static_cast<std::size_t>(view.range_bins), static_cast<std::size_t>(view.beams)});
        });
}

/// raw.npy: 8 or 16 bits, the output of the calibrated model's instrument, in the shape of the
/// sonar's other records. raw.png is the same as a picture; a scanning sonar has a picture [range,
/// step] for each sweep, raw_0000.png and so on. Values of an instrument have no mean: where
/// several pings share a row of the picture, it shows the first of them.
std::optional<Writer> make_raw_records_writer(const WriterContext& context) {
    const int bytes = raw_bytes(context);
    if (bytes == 0 || context.kind().has_images) return std::nullopt;
    const RecordShape& shape = context.kind().record;
    const SonarConfig& config = context.sonar().config;
    Writer writer = array_writer(
        record_of_kind(context, "raw", bytes == 1 ? "|u1" : "<u2", "raw"),
        [=, &shape, &config](const FinishedPing& f) {
            const std::vector<std::uint16_t> raw = context.sonar().settings.model->raw(f.ping);
            return raw_numbers(record_values<std::uint16_t>(shape, config, raw, 0), bytes,
                               {shape.values(config)});
        });
    if (shape.pictures == RecordPictures::sweeps) {
        for (std::size_t sweep = 0; sweep < scan_sweeps(config, context.pings); ++sweep)
            writer.products.push_back(scan_file_name("raw", sweep, ".png"));
    } else {
        writer.products = {"raw.png"};
    }
    writer.write_products = [=](const RecordFile& records, const std::filesystem::path& folder) {
        bytes == 1 ? write_raw_pictures<std::uint8_t>(context, records, folder)
                   : write_raw_pictures<std::uint16_t>(context, records, folder);
    };
    return writer;
}

}  // namespace sonarsim
