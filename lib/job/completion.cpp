#include "job/completion.h"

#include "core/file.h"
#include "dataset/ping_metadata.h"
#include "dataset/record_objects.h"
#include "job/checksums.h"

namespace sonarsim {

void complete_dataset(const Layout& layout, const Mission& mission,
                      const std::vector<Writers>& writers, RecordFiles& records,
                      const CommonFiles& common) {
    const auto for_each_record = [&](const auto& visit) {
        for (std::size_t i = 0; i < writers.size(); ++i) {
            for (std::size_t k = 0; k < writers[i].size(); ++k) {
                if (records[i][k]) visit(i, k);
            }
        }
    };
    for_each_record([&](std::size_t i, std::size_t k) {
        writers[i][k]->write_products(*records[i][k], layout.sensor_folder(i));
    });
    require_records(records);
    for_each_record([&](std::size_t i, std::size_t k) { records[i][k]->close(); });
    write_record_objects(layout, mission, common.description);
    JournalEntries entries = read_journal(layout.folder);
    entries.products = require_products(layout);
    write_journal(layout.folder / journal_name, entries);
    // dataset.json says `complete` only after everything else is durable.
    sync_file_system(layout.folder);
    nlohmann::ordered_json finished = common.description;
    finished["complete"] = true;
    const std::string text = json_text(finished);
    write_checksums(layout, entries, text);
    sync_file_system(layout.folder);
    write_file_durably(layout.folder / description_name, text);
    remove_journal_parts(layout);
}

}  // namespace sonarsim
