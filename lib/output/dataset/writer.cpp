#include "output/dataset/writer.h"

#include <utility>

namespace sonarsim {

PingRecord record_of_kind(const WriterContext& context, const std::string& stem, const char* type,
                          std::string label, std::string ids) {
    const RecordShape& shape = context.kind().record;
    PingRecord record{.file = stem + ".npy",
                      .format = {type, {context.pings, shape.values(context.sonar().config)}},
                      .axes = {"ping", shape.axis},
                      .label = std::move(label),
                      .ids = std::move(ids)};
    if (!record.label.empty() && shape.bins)
        record.axes[1] = "column, as in " + std::string(shape.name) + ".npy";
    if (shape.upright) {
        std::swap(record.format.shape[0], record.format.shape[1]);
        std::swap(record.axes[0], record.axes[1]);
        record.format.fortran_order = true;
    }
    return record;
}

Writer array_writer(PingOutput per_ping, std::function<PingNumbers(const FinishedPing&)> numbers,
                    PngFilter filter) {
    const bool is_record = std::holds_alternative<PingRecord>(per_ping);
    const auto encode = [=](const FinishedPing& ping) {
        const PingNumbers all = numbers(ping);
        if (is_record) return record_bytes(all);
        const auto rows = static_cast<int>(all.shape[0]);
        const auto columns = static_cast<int>(all.shape[1]);
        if (const auto* floats = std::get_if<std::vector<float>>(&all.values))
            return npy_bytes(*floats, rows, columns);
        if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&all.values))
            return png_bytes(*bytes, columns, rows);
        return png_bytes(std::get<std::vector<std::uint16_t>>(all.values), columns, rows, filter);
    };
    return {.per_ping = std::move(per_ping), .encode = encode, .numbers = std::move(numbers)};
}

}  // namespace sonarsim
