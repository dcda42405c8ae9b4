#include "job/ping_files.h"

#include <span>
#include <utility>

#include "core/file.h"
#include "core/sha256.h"
#include "job/journal.h"

namespace sonarsim {

namespace {

/// A ping's file is an image or JSON.
constexpr std::size_t largest_ping_file = std::size_t{1} << 32;

}  // namespace

std::vector<std::vector<std::string>> journal_fields(std::span<const PingToList> pings) {
    std::vector<std::vector<std::string>> fields;
    for (const PingToList& ping : pings) {
        std::vector<std::string>& own = fields.emplace_back();
        for (std::size_t k = 0; k < ping.encoded.size(); ++k) {
            const std::string& bytes = ping.encoded[k];
            own.push_back(std::holds_alternative<PingRecord>(ping.sensor.per_ping[k])
                              ? hash_of_record(bytes)
                              : entry_text({bytes.size(), sha256(bytes)}));
        }
    }
    return fields;
}

EncodedPing read_ping(const Layout& layout, const RecordFiles& records, const PingId& ping) {
    const SensorLayout& sensor = layout.sensors[ping.sensor];
    EncodedPing encoded;
    for (std::size_t k = 0; k < sensor.per_ping.size(); ++k) {
        if (const auto* file = std::get_if<PingFile>(&sensor.per_ping[k])) {
            encoded.push_back(read_file(layout.file(ping, *file), largest_ping_file));
            continue;
        }
        const RecordFile& source = *records[ping.sensor][k];
        std::string& bytes = encoded.emplace_back(source.record_bytes(), '\0');
        source.read(layout.record_of(ping), std::as_writable_bytes(std::span(bytes)));
    }
    return encoded;
}

void write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                const EncodedPing& encoded) {
    const SensorLayout& sensor = layout.sensors[ping.sensor];
    for (std::size_t k = 0; k < encoded.size(); ++k) {
        if (const auto* file = std::get_if<PingFile>(&sensor.per_ping[k])) {
            write_file(layout.file(ping, *file), encoded[k]);
        } else {
            records[ping.sensor][k]->write(layout.record_of(ping),
                                           std::as_bytes(std::span(encoded[k])));
        }
    }
}

}  // namespace sonarsim
