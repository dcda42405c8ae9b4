#include "output/dataset/strip_rows.h"
#include "output/dataset/writer.h"
#include "simulate/product/scan.h"

namespace sonarsim {

namespace {

/// True if a value of the sonar's instrument has one byte, not two.
bool has_bytes(const Sonar& sonar) {
    return sonar.settings.model->info.raw_bits <= 8;
}

/// The output of the instrument of the calibrated model.
PingNumbers raw_numbers(const Sonar& sonar, const Ping& ping) {
    PingNumbers numbers = numbers_of<std::uint16_t>(sonar, sonar.settings.model->raw(ping), 0);
    if (!has_bytes(sonar)) return numbers;
    const auto& values = std::get<std::vector<std::uint16_t>>(numbers.values);
    return {std::vector<std::uint8_t>(values.begin(), values.end()), std::move(numbers.shape)};
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
        for_each_sweep(config, context.pings,
                       [&](std::size_t sweep, std::size_t begin, std::size_t end) {
                           std::vector<T> display(values * steps);
                           for (std::size_t k = begin; k < end; ++k) {
                               read(k);
                               const auto step = static_cast<std::size_t>(scan_step(config, k));
                               for (std::size_t i = 0; i < values; ++i)
                                   display[i * steps + step] = ping[i];
                           }
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
/// For sonars without images raw.npy, in the shape of their other records, with the picture
/// raw.png, or raw_NNNN.png [range, step] for each sweep. Values of an instrument have no mean:
/// where several pings share a row of the picture, it shows the first of them.
Writer make_raw_writer(const WriterContext& context) {
    const bool bytes = has_bytes(context.sonar());
    const auto numbers = [&sonar = context.sonar()](const FinishedPing& finished) {
        return raw_numbers(sonar, finished.ping);
    };
    if (context.kind().has_images)
        return array_writer(PingFile{"raw", ".png", PingArray::bins, {}, "raw"}, numbers);
    Writer writer =
        array_writer(record_of_kind(context, "raw", bytes ? "|u1" : "<u2", "raw"), numbers);
    if (context.kind().record.pictures == RecordPictures::sweeps)
        writer.products = sweep_files(context, "raw", {".png"});
    else
        writer.products = {"raw.png"};
    writer.write_products = std::bind_front(
        bytes ? write_raw_pictures<std::uint8_t> : write_raw_pictures<std::uint16_t>, context);
    return writer;
}

}  // namespace sonarsim
