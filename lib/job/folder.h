#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/layout.h"

namespace sonarsim {

enum class FolderState {
    fresh,       ///< holds nothing yet
    unfinished,  ///< holds a part of this very dataset
    complete,    ///< holds all of it, by its dataset.json
};

/// The keys in which the mission of a dataset differs from the text `mission`, for messages.
std::string mission_differences(const std::filesystem::path& dataset, const std::string& mission);

/// The state of the output folder, seen from the dataset that `description` (dataset.json) and
/// `mission` (mission.resolved.yaml) stand for. InputError when it holds something else: other
/// files, or a dataset of another mission, of other input files or of another version of the
/// program.
FolderState inspect_folder(const Layout& layout, const nlohmann::ordered_json& description,
                           const std::string& mission);

/// True if a folder holds only files of a run that was killed at its beginning.
bool is_unused(const std::filesystem::path& folder);

/// InputError when the path is a symbolic link. `what` is what a user writes there: "a dataset".
void require_no_link(const std::filesystem::path& path, const std::string& what);

/// InputError when writing the dataset would touch what is not its own: a file that the mission
/// reads, or something behind a symbolic link. The folder of the dataset itself may be a link.
void protect_inputs(const Layout& layout, const Mission& mission);

/// Removes the files that the folder's dataset.json lists, and nothing else; no link is followed.
/// The removal is durable, so that a new dataset is never found with an old journal. InputError
/// when the folder holds files but no dataset of sonarsim, or when dataset.json lists a file that
/// the mission reads.
void remove_dataset(const Layout& layout, const Mission& mission);

/// Removes the files that dataset.json (`description`) lists, complete or temporary, the gallery,
/// and the folders that are empty then. Other files stay, and so does everything behind a symbolic
/// link. No description can make it touch a file outside `folder`. InputError, and nothing is
/// removed, when it lists one of `inputs`, which the mission reads.
void remove_listed_files(const std::filesystem::path& folder,
                         const nlohmann::ordered_json& description,
                         const std::vector<std::filesystem::path>& inputs);

/// The text of the files that do not belong to one ping.
struct CommonFiles {
    nlohmann::ordered_json description;  ///< dataset.json
    std::string mission;                 ///< mission.resolved.yaml
    std::string trajectory;              ///< trajectory.tum
    /// Names relative to the folder and bytes of the shared products that are there from the
    /// beginning.
    std::vector<std::pair<std::string, std::string>> initial = {};
};

/// Makes the folder ready for pings: common files and subfolders, dataset.json first, durably and
/// with `complete` set to false. std::system_error when the disk does not take them.
void begin_dataset(const Layout& layout, const CommonFiles& files);

/// True if the common files other than dataset.json and the journal are there.
bool has_common_files(const Layout& layout);

/// Removes the temporary files that lie in the folder itself, which may be missing.
void remove_temporary_files(const std::filesystem::path& folder);

/// Removes the temporary files of the pings in `todo` (sorted) that an interrupted run left, and
/// with `alone`, when no other shard may be at work, those of the common files.
void remove_leftovers(const Layout& layout, const std::vector<PingId>& todo, bool alone);

/// Removes the parts of the journal, and no other file. A run that was killed just before its end
/// leaves them.
void remove_journal_parts(const Layout& layout);

}  // namespace sonarsim
