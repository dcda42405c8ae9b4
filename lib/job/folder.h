#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/layout.h"
#include "job/journal.h"

namespace sonarsim {

enum class FolderState {
    fresh,       ///< holds nothing yet
    unfinished,  ///< holds a part of this very dataset
    complete,    ///< says that it holds all of it
};

/// What the output folder holds, seen from the dataset that `description` (dataset.json) stands
/// for. InputError when it holds something else: other files, or a dataset of another mission, of
/// other input files or of another version of the program.
FolderState inspect_folder(const Layout& layout, const nlohmann::ordered_json& description);

/// InputError when writing the dataset would touch what is not its own: a file that the mission
/// reads, or something behind a symbolic link. The folder of the dataset itself may be a link.
void protect_inputs(const Layout& layout, const Mission& mission);

/// Removes the files that the folder's dataset.json lists, and nothing else; no link is followed.
/// Durably, so that what comes after it is never found beside an old journal. InputError when the
/// folder holds files and no dataset of sonarsim, or when that lists a file that the mission reads.
void remove_dataset(const Layout& layout, const Mission& mission);

/// The text of the files that stand beside the pings.
struct CommonFiles {
    nlohmann::ordered_json description;  ///< dataset.json
    std::string mission;                 ///< mission.resolved.yaml
    std::string trajectory;              ///< trajectory.tum
};

/// Makes the folder ready for pings: common files and subfolders, dataset.json first, durably and
/// with `complete` set to false. std::system_error when the disk does not take them.
void begin_dataset(const Layout& layout, const CommonFiles& files);

/// Whether the files beside dataset.json and the journal are there.
bool has_common_files(const Layout& layout);

/// Removes the temporary files that an interrupted run left of the pings in `todo` (sorted), and of
/// the common files when no other shard may be at work (`alone`).
void remove_leftovers(const Layout& layout, const std::vector<PingId>& todo, bool alone);

/// Removes the parts of the journal, and no other file. A run that was cut off just before its end
/// leaves them.
void remove_journal_parts(const Layout& layout);

/// Writes journal.txt, SHA256SUMS and then dataset.json with `complete` set to true, all durably,
/// after all else has become durable; then the parts of the journal go.
void finish_dataset(const Layout& layout, const nlohmann::ordered_json& description,
                    const JournalEntries& entries);

}  // namespace sonarsim
