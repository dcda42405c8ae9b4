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

}  // namespace sonarsim
