#include "export/destination.h"

#include <algorithm>

#include "core/error.h"
#include "core/file.h"
#include "dataset/checked_json.h"
#include "dataset/ping_metadata.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* mark_name = ".sonarsim-export.json";
constexpr std::size_t largest_mark = std::size_t{1} << 28;

/// The mark in a folder; null if it has none.
Json mark_of(const fs::path& folder) {
    const fs::path file = folder / mark_name;
    if (!fs::is_regular_file(fs::symlink_status(file))) return nullptr;
    Json json = read_json(file, largest_mark);
    const bool ours = json.is_object() && json.value("format", Json()) == "sonarsim export";
    return ours ? json : Json();
}

/// The folder without a slash at its end.
fs::path plain_path(const fs::path& folder) {
    const fs::path path = fs::absolute(folder).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

bool lies_in(const fs::path& path, const fs::path& folder) {
    const fs::path inner = fs::weakly_canonical(path);
    const fs::path outer = fs::weakly_canonical(folder);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
           outer.end();
}

}  // namespace

ExportDestination::ExportDestination(const fs::path& dest, const Json& identity,
                                     const std::vector<fs::path>& sources)
    : dest_(plain_path(dest)), part_(dest_.string() + ".part") {
    for (const fs::path& source : sources) {
        if (lies_in(dest_, source))
            throw InputError({dest.string()}, "lies in the dataset; choose a folder outside of it");
    }
    const fs::file_status status = fs::symlink_status(dest_);
    if (fs::exists(status) && !(fs::is_directory(status) && fs::is_empty(dest_))) {
        if (fs::is_directory(status) && mark_of(dest_) == identity) return;
        throw InputError(
            {dest.string()},
            "holds something else than this export; choose another folder, or remove it");
    }
    const fs::file_status old = fs::symlink_status(part_);
    const bool is_ours = !fs::exists(old) || (fs::is_directory(old) &&
                                              (fs::is_empty(part_) || !mark_of(part_).is_null()));
    if (!is_ours)
        throw InputError({part_.string()},
                         "holds something else than an unfinished export; remove it");
    lock_.emplace(lock_alone(part_));
    for (const fs::directory_entry& entry : fs::directory_iterator(part_)) {
        // The mark is removed last, since it identifies the folder.
        if (entry.path().filename() != mark_name) fs::remove_all(entry.path());
    }
    write_file_durably(part_ / mark_name, json_text(identity));
}

ExportDestination::~ExportDestination() {
    if (!lock_ || committed_) return;
    std::error_code ignored;
    fs::remove_all(part_, ignored);
}

void ExportDestination::commit() {
    sync_file_system(part_);
    fs::rename(part_, dest_);
    committed_ = true;
}

}  // namespace sonarsim
