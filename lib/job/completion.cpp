#include "job/completion.h"

#include <stdexcept>

#include "core/atomic_file.h"
#include "core/file.h"
#include "core/sha256.h"
#include "dataset/metadata.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

void add_sum(StreamedFile& sums, std::string_view sum, const std::string& name) {
    sums.append(std::string(sum) + "  " + name + '\n');
}

/// Adds the sums of the pings' files from the journal, in the order of the writers.
void add_ping_files(StreamedFile& sums, const Layout& layout, std::uint32_t sensor,
                    const JournalEntries& entries) {
    const SensorLayout& own = layout.sensors[sensor];
    for (std::size_t k = 0; k < own.per_ping.size(); ++k) {
        const auto* file = std::get_if<PingFile>(&own.per_ping[k]);
        if (!file) continue;
        for (std::uint32_t ping = 0; ping < own.pings; ++ping) {
            const PingId id{ping * own.every, sensor};
            const fs::path path = layout.file(id, *file);
            const auto entry = entries.find(id);
            if (entry == entries.end())
                throw std::runtime_error("the journal does not list " + path.string());
            const std::string_view field = split_fields(entry->second).at(k);
            add_sum(sums, field.substr(field.find(':') + 1),
                    path.lexically_relative(layout.folder).string());
        }
    }
}

/// Writes OUT/SHA256SUMS for `sha256sum -c` in OUT: every file of the dataset but this one. The sum
/// of dataset.json is that of `description`, which is written to it afterwards.
void write_checksums(const Layout& layout, const JournalEntries& entries,
                     const std::string& description) {
    StreamedFile sums(layout.folder / checksums_name);
    const auto add_file = [&](const std::string& name) {
        add_sum(sums, sha256_of_file(layout.folder / name), name);
    };
    add_sum(sums, sha256(description), description_name);
    for (const char* name : {mission_name, trajectory_name, journal_name})
        add_file(name);
    for (std::uint32_t i = 0; i < layout.sensors.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        add_ping_files(sums, layout, i, entries);
        for (const auto& part : sensor.per_ping) {
            if (const auto* record = std::get_if<PingRecord>(&part))
                add_file(sensor.name + "/" + record->file);
        }
        for (const std::string& product : sensor.products)
            add_file(sensor.name + "/" + product);
    }
    for (const std::string& product : layout.products)
        add_file(product);
    sums.finish();
}

}  // namespace

void complete_dataset(const Layout& layout, const std::vector<Writers>& writers,
                      RecordFiles& records, const CommonFiles& common) {
    remove_leftovers_of_pings(layout);
    for (std::size_t i = 0; i < writers.size(); ++i) {
        for (std::size_t k = 0; k < writers[i].size(); ++k) {
            if (!records[i][k]) continue;
            const Writer& writer = writers[i][k];
            if (writer.write_products)
                writer.write_products(*records[i][k], layout.sensor_folder(i));
            records[i][k]->close();
        }
    }
    const JournalEntries entries = read_journal(layout.folder);
    write_journal(layout.folder / journal_name, entries);
    // dataset.json says `complete` only after everything else is durable.
    sync_file_system(layout.folder);
    nlohmann::ordered_json finished = common.description;
    finished["complete"] = true;
    const std::string text = json_text(finished);
    write_checksums(layout, entries, text);
    sync_file_system(layout.folder);
    write_file_durably(layout.folder / description_name, text);
}

}  // namespace sonarsim
