#include "job/resume.h"

#include <sys/stat.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <variant>

#include "job/folder.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// The size of a regular file; nothing for anything else.
std::optional<std::uint64_t> size_of(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return static_cast<std::uint64_t>(status.st_size);
}

/// Visits the products. Those made of all sensors get the index after the last sensor's.
template <class Visit>
void for_each_product(const Layout& layout, const Visit& visit) {
    for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
        for (const std::string& name : layout.sensors[i].products)
            visit(i, name);
    }
    for (const std::string& name : layout.products)
        visit(static_cast<std::uint32_t>(layout.sensors.size()), name);
}

}  // namespace

RecordFiles open_records(const Layout& layout, RecordAccess access, std::size_t datasets) {
    std::size_t records = 0;
    for (const SensorLayout& sensor : layout.sensors)
        records += std::ranges::count_if(sensor.per_ping, [](const auto& part) {
            return std::holds_alternative<PingRecord>(part);
        });
    const KeepOpen keep = records * datasets <= most_files_kept_open ? KeepOpen::yes : KeepOpen::no;
    RecordFiles files(layout.sensors.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        for (const auto& part : sensor.per_ping) {
            const auto* record = std::get_if<PingRecord>(&part);
            files[i].push_back(
                record ? std::make_unique<RecordFile>(layout.sensor_folder(i) / record->file,
                                                      record->format, sensor.pings, access, keep)
                       : nullptr);
        }
    }
    return files;
}

FinishedPings::FinishedPings(const Layout& layout, const RecordFiles& records)
    : layout_(layout), records_(records), entries_(read_journal(layout.folder)) {}

std::vector<std::string> FinishedPings::fields_of(const PingId& ping) const {
    return entries_.pings.find(ping).value();
}

bool FinishedPings::operator()(const PingId& ping) const {
    const auto fields = entries_.pings.find(ping);
    const auto& parts = layout_.sensors[ping.sensor].per_ping;
    if (!fields || fields->size() != parts.size()) return false;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::string& expected = (*fields)[k];
        if (const auto* file = std::get_if<PingFile>(&parts[k])) {
            const auto entry = parse_entry(expected);
            if (!entry || size_of(layout_.file(ping, *file)) != entry->bytes) return false;
        } else if (records_[ping.sensor][k]->hash(layout_.record_of(ping)) != expected) {
            return false;
        }
    }
    return true;
}

void require_records(const RecordFiles& records) {
    for (const auto& sensor : records) {
        for (const auto& file : sensor) {
            if (file) file->require_in_place();
        }
    }
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

ProductSizes require_products(const Layout& layout) {
    ProductSizes sizes;
    for_each_product(layout, [&](std::uint32_t sensor, const std::string& name) {
        const fs::path path = layout.product_file(sensor, name);
        const auto size = size_of(path);
        if (!size)
            throw std::runtime_error(path.string() +
                                     " was removed during the run; the same "
                                     "command run again makes it anew");
        sizes[{sensor, name}] = *size;
    });
    return sizes;
}

namespace {

/// True if every product is there with the size that the journal lists.
bool has_products(const Layout& layout) {
    const ProductSizes expected = read_journal(layout.folder).products;
    bool all = true;
    for_each_product(layout, [&](std::uint32_t sensor, const std::string& name) {
        const auto entry = expected.find({sensor, name});
        all = all && entry != expected.end() &&
              size_of(layout.product_file(sensor, name)) == entry->second;
    });
    return all;
}

}  // namespace

bool has_all(const Layout& layout, const std::vector<PingId>& pings) {
    if (!has_common_files(layout) || !has_products(layout)) return false;
    try {
        const RecordFiles records = open_records(layout, RecordAccess::read);
        return std::ranges::all_of(pings, FinishedPings(layout, records));
    } catch (const std::runtime_error&) {
        return false;  // a file of records is missing or damaged
    }
}

}  // namespace sonarsim
