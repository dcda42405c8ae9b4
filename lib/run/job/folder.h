#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/dataset/dataset_file.h"
#include "output/dataset/json.h"
#include "output/dataset/layout.h"

namespace sonarsim {

enum class FolderState {
    fresh,       ///< holds nothing yet
    unfinished,  ///< holds a part of this very dataset
    complete,    ///< holds all of it, by its dataset.json
};

/// The text of the files that do not belong to one ping.
struct CommonFiles {      // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    Json description;     ///< dataset.json, not complete
    std::string mission;  ///< mission.resolved.yaml
    /// Names relative to the folder and bytes of the trajectory and the shared products.
    std::vector<std::pair<std::string, std::string>> others = {};
};

CommonFiles make_common_files(const Mission& mission, const Assembly& assembly,
                              const Layout& layout);

/// Their size on the disk, bytes.
double bytes_of(const CommonFiles& files);

/// The mission.resolved.yaml of a dataset. InputError as read_file().
std::string read_mission_text(const std::filesystem::path& dataset);

/// The keys in which the mission of a dataset differs from the text `mission`, for messages.
std::string mission_differences(const std::filesystem::path& dataset, const std::string& mission);

/// The dataset in a folder that holds all or a part of `first`. InputError when it holds another.
DatasetFile require_part(const std::filesystem::path& folder, const std::filesystem::path& first);

/// True if a folder holds only files of a run that was killed at its beginning.
bool is_unused(const std::filesystem::path& folder);

/// The state of a folder, seen from the dataset that `description` (dataset.json) and `mission`
/// (mission.resolved.yaml) stand for. InputError when it holds other files or a dataset that
/// difference_between() tells apart; with `overwrite` a folder with any dataset counts as fresh.
FolderState inspect_folder(const std::filesystem::path& folder, const Json& description,
                           const std::string& mission, bool overwrite = false);

/// InputError when writing the dataset would touch what is not its own: a file that the mission
/// reads, or something behind a symbolic link. The folder of the dataset itself may be a link.
void protect_inputs(const Layout& layout, const Mission& mission);

/// Removes the folders of the sensors of a dataset, with all that is in them, and the files of the
/// dataset next to these; no link is followed. Durable: a new dataset is never found with an old
/// journal. The caller holds the lock of a whole run. InputError for a file that the mission reads.
void remove_dataset(const std::filesystem::path& folder, const Mission& mission);

/// True if all files of a complete dataset are in the folder.
bool has_files(const std::filesystem::path& folder, const DatasetFile& dataset);

/// Creates a file durably, with all of its bytes at once. False if the name is in use: of several
/// processes one creates it. std::system_error when the disk refuses.
bool create_once(const std::filesystem::path& path, const std::string& text);

/// Makes dataset.json, which decides what the folder holds: of several runs one makes it, and the
/// others find it, or InputError as inspect_folder(). Returns the state before.
FolderState claim_folder(const std::filesystem::path& folder, const CommonFiles& files);

/// Makes the folder ready for pings: subfolders, and the common files but dataset.json.
void write_common_files(const Layout& layout, const CommonFiles& files);

/// Removes the temporary files that interrupted runs left in a folder, if there is one, and in
/// those in it that `description` (dataset.json) names. Nobody may be at work there.
void remove_leftovers(const std::filesystem::path& folder,
                      const Json& description = Json::object());

/// Removes what killed runs left in the folder of a complete dataset, or of variants: parts of the
/// journal and, where it can take the lock of the folder, temporary files.
void tidy(const std::filesystem::path& folder, const Json& description);

}  // namespace sonarsim
