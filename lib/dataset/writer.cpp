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

}  // namespace sonarsim
