#include "dataset/writer.h"

#include <utility>

namespace sonarsim {

WriterOutputs record_outputs(std::string file, NpyFormat format, nlohmann::ordered_json axes,
                             double bytes) {
    WriterOutputs outputs;
    PingRecord& record = outputs.per_ping.emplace<PingRecord>();
    record.file = std::move(file);
    record.format = std::move(format);
    record.axes = std::move(axes);
    outputs.bytes_per_ping = bytes;
    return outputs;
}

WriterOutputs record_outputs(const WriterContext& context, const std::string& stem,
                             const char* type, int bytes_of_number, std::string label) {
    const RecordShape& shape = context.kind().record;
    const std::size_t values = shape.values(context.sonar().config);
    NpyFormat format{type, {context.pings, values}};
    nlohmann::ordered_json axes = {"ping", shape.axis};
    if (!label.empty() && shape.bins) axes[1] = "column, as in " + std::string(shape.name) + ".npy";
    if (shape.upright) {
        std::swap(format.shape[0], format.shape[1]);
        std::swap(axes[0], axes[1]);
        format.fortran_order = true;
    }
    WriterOutputs outputs =
        record_outputs(stem + ".npy", std::move(format), std::move(axes),
                       static_cast<double>(bytes_of_number) * static_cast<double>(values));
    std::get<PingRecord>(outputs.per_ping).label = std::move(label);
    return outputs;
}

Writer array_writer(WriterOutputs outputs, std::function<PingNumbers(const FinishedPing&)> numbers,
                    PngFilter filter) {
    const bool is_record = std::holds_alternative<PingRecord>(outputs.per_ping);
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
    return {.outputs = std::move(outputs), .encode = encode, .numbers = std::move(numbers)};
}

}  // namespace sonarsim
