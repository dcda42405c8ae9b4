#include "run/job/ping_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>

#include "core/file.h"
#include "core/sha256.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// The size of a regular file as text; "" for anything else.
std::string size_of(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return "";
    return std::to_string(status.st_size);
}

}  // namespace

RecordFiles open_records(const Layout& layout, RecordAccess access) {
    RecordFiles files(layout.sensors.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        for (const auto& part : sensor.per_ping) {
            const auto* record = std::get_if<PingRecord>(&part);
            files[i].push_back(
                record ? std::make_unique<RecordFile>(layout.sensor_folder(i) / record->file,
                                                      record->format, sensor.pings, access)
                       : nullptr);
        }
    }
    return files;
}

std::string write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                       const std::vector<std::string>& encoded) {
    const SensorLayout& sensor = layout.sensors[ping.sensor];
    std::string fields;
    for (std::size_t k = 0; k < encoded.size(); ++k) {
        const std::string& bytes = encoded[k];
        if (k > 0) fields += ' ';
        if (const auto* file = std::get_if<PingFile>(&sensor.per_ping[k])) {
            write_file(layout.file(ping, *file), bytes);
            fields += std::to_string(bytes.size()) + ':' + sha256(bytes);
        } else {
            records[ping.sensor][k]->write(layout.record_of(ping), std::as_bytes(std::span(bytes)));
            fields += hash_of_record(bytes);
        }
    }
    return fields;
}

FinishedPings::FinishedPings(const Layout& layout) : layout_(layout) {
    try {
        records_ = open_records(layout, RecordAccess::read);
    } catch (const std::runtime_error&) {
        return;  // a file of records is missing or damaged, so no ping is finished
    }
    entries_ = read_journal(layout.folder);
}

bool FinishedPings::has(const PingId& ping) const {
    const auto entry = entries_.find(ping);
    if (entry == entries_.end()) return false;
    std::istringstream fields(entry->second);
    const auto& parts = layout_.sensors[ping.sensor].per_ping;
    std::string field;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!(fields >> field)) return false;
        if (const auto* file = std::get_if<PingFile>(&parts[k])) {
            const std::string size = size_of(layout_.file(ping, *file));
            if (size.empty() || !field.starts_with(size + ':')) return false;
        } else if (records_[ping.sensor][k]->hash(layout_.record_of(ping)) != field) {
            return false;
        }
    }
    return !(fields >> field);
}

bool FinishedPings::has_all(const std::vector<PingId>& pings) const {
    return std::ranges::all_of(pings, [this](const PingId& ping) { return has(ping); });
}

std::vector<PingId> FinishedPings::missing(std::vector<PingId> pings) const {
    std::erase_if(pings, [this](const PingId& ping) { return has(ping); });
    return pings;
}

}  // namespace sonarsim
