#include "dataset/resume.h"

#include <optional>
#include <stdexcept>
#include <variant>

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// Of a regular file; nothing for anything else.
std::optional<std::uint64_t> size_of(const fs::path& path) {
    std::error_code absent;
    if (fs::symlink_status(path, absent).type() != fs::file_type::regular) return std::nullopt;
    const std::uint64_t size = fs::file_size(path, absent);
    return absent ? std::nullopt : std::optional(size);
}

}  // namespace

RecordFiles open_records(const Layout& layout) {
    RecordFiles files(layout.sensors.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        for (const auto& part : sensor.per_ping) {
            const auto* record = std::get_if<PingRecord>(&part);
            files[i].push_back(
                record ? std::make_unique<RecordFile>(layout.sensor_folder(i) / record->file,
                                                      record->format, sensor.pings)
                       : nullptr);
        }
    }
    return files;
}

FinishedPings::FinishedPings(const Layout& layout, const RecordFiles& records)
    : layout_(layout), records_(records), entries_(read_journal(layout.folder)) {}

bool FinishedPings::operator()(const PingId& ping) const {
    const auto entry = entries_.pings.find(ping);
    const auto& parts = layout_.sensors[ping.sensor].per_ping;
    if (entry == entries_.pings.end() || entry->second.size() != parts.size()) return false;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::string& expected = entry->second[k];
        if (const auto* file = std::get_if<PingFile>(&parts[k])) {
            const auto size = size_of(layout_.file(ping, *file));
            if (!size || std::to_string(*size) != expected) return false;
        } else if (records_[ping.sensor][k]->hash(layout_.record_of(ping)) != expected) {
            return false;
        }
    }
    return true;
}

void require_files(const Layout& layout, const std::vector<PingId>& written,
                   const FinishedPings& finished) {
    for (const PingId& ping : written) {
        if (finished(ping)) continue;
        throw std::runtime_error("files of ping " + std::to_string(ping.pose) + " in " +
                                 layout.sensor_folder(ping.sensor).string() +
                                 " were changed or removed during the run; the same command run "
                                 "again renders what is missing");
    }
}

std::map<std::pair<std::uint32_t, std::string>, std::uint64_t> product_sizes(const Layout& layout) {
    std::map<std::pair<std::uint32_t, std::string>, std::uint64_t> sizes;
    for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
        for (const std::string& name : layout.sensors[i].products) {
            if (const auto size = size_of(layout.sensor_folder(i) / name)) sizes[{i, name}] = *size;
        }
    }
    return sizes;
}

bool has_products(const Layout& layout) {
    std::size_t products = 0;
    for (const SensorLayout& sensor : layout.sensors)
        products += sensor.products.size();
    const auto sizes = product_sizes(layout);
    return sizes.size() == products && sizes == read_journal(layout.folder).products;
}

}  // namespace sonarsim
