#include <fstream>

#include "core/error.h"
#include "core/file.h"
#include "run/job/dataset_folders.h"
#include "run/job/folder.h"
#include "run/job/journal.h"
#include "run/job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// InputError when a file of a part, or a folder on the way to it, is a link: the part may come
/// from anybody, and what a link names may be private.
void require_own(const fs::path& part, const fs::path& name) {
    for (fs::path inner = name; !inner.empty(); inner = inner.parent_path()) {
        if (!fs::is_symlink(part / inner)) continue;
        throw InputError({(part / inner).string()},
                         "is a symbolic link, and merge follows none within a part; put the files "
                         "themselves in its place");
    }
}

/// require_own() for all that is read of a part, or of a variant in it, but the files of pings.
void require_own_dataset(const fs::path& part, const fs::path& variant) {
    for (const char* name : {variants_name, description_name, mission_name, journal_name,
                             journal_folder_name, checksums_name})
        require_own(part, variant / name);
}

/// Copies a file of a dataset, and makes the folders above it. A link in its place is replaced.
void copy_file(const fs::path& from, const fs::path& to, const std::string& name) {
    for (fs::path inner = fs::path(name).parent_path(); !inner.empty(); inner = inner.parent_path())
        require_no_link(to / inner, "a dataset");
    require_own(from, name);
    fs::create_directories((to / name).parent_path());
    copy_regular_file(from / name, to / name);
}

/// Copies one of `pings` equal records between two NumPy files. The first one comes with its file.
void copy_record(const fs::path& from, const fs::path& to, const std::string& name,
                 std::uint64_t pings, std::uint64_t record) {
    require_no_link((to / name).parent_path(), "a dataset");
    require_no_link(to / name, "a dataset");
    if (!fs::exists(to / name)) return copy_file(from, to, name);
    require_own(from, name);
    constexpr std::size_t longest_header = 1024;
    const std::size_t begin = read_bytes(from / name, 0, longest_header).find('\n') + 1;
    const std::size_t size = (std::max(fs::file_size(from / name), begin) - begin) / pings;
    if (begin == 0) throw InputError({(from / name).string()}, "is not a .npy file");
    const std::string bytes = read_bytes(from / name, begin + record * size, size);
    std::fstream target(to / name, std::ios::in | std::ios::out | std::ios::binary);
    const auto at = static_cast<std::streamoff>(begin + record * size);
    if (!target.seekp(at).write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
        throw_errno("cannot write", to / name);
}

/// The datasets of one mission, and the folder that they are copied to.
class DatasetMerge {
  public:
    DatasetMerge(const std::vector<fs::path>& parts, const fs::path& out)
        : parts_(parts), out_(out), dataset_(require_dataset(parts.at(0))) {
        common_.description = dataset_.json;
        common_.description["complete"] = false;
        common_.mission = read_mission_text(parts[0]);
        for (const fs::path& part : parts)
            require_part(part, parts[0]);
        inspect_folder(out, common_.description, common_.mission);
    }

    void run(const std::atomic<bool>& stop, MergeSummary& summary) {
        ShardLock lock(out_, 0, 1);
        summary.unlocked = summary.unlocked || !lock.works();
        remove_leftovers(out_, common_.description);
        if (claim_folder(out_, common_) == FolderState::complete) {
            lock.remove_parts();  // a run was killed at its very end
            summary.skipped += count_pings(dataset_);
            return;
        }
        const auto whole = std::ranges::find_if(parts_, is_complete);
        if (whole != parts_.end()) {
            copy_whole(*whole);
            lock.remove_parts();
            summary.pings += count_pings(dataset_);
        } else {
            copy_pings(lock, stop, summary);
            summary.complete = false;
        }
    }

  private:
    void copy_whole(const fs::path& part) const {
        const DatasetFile complete = require_dataset(part);
        for (const std::string& name : list_files(part, complete)) {
            if (name != description_name) copy_file(part, out_, name);
        }
        copy_file(part, out_, checksums_name);
        sync_file_system(out_);
        write_file_durably(out_ / description_name, json_text(complete.json));
    }

    void copy_pings(const ShardLock& lock, const std::atomic<bool>& stop,
                    MergeSummary& summary) const {
        constexpr double checkpoint_s = 5.0;
        write_file(out_ / mission_name, common_.mission);
        JournalEntries there = read_journal(out_);
        summary.skipped += there.size();
        Journal journal(lock, checkpoint_s);
        for (const fs::path& part : parts_) {
            for (const auto& [ping, fields] : read_journal(part)) {
                if (stop) summary.stopped = true;
                if (stop || !is_of_dataset(ping) || !there.emplace(ping, fields).second) continue;
                copy_ping(part, ping);
                journal.add(ping, fields);
                ++summary.pings;
            }
        }
        journal.finish();
        summary.missing += count_pings(dataset_) - there.size();
    }

    bool is_of_dataset(const PingId& ping) const {
        return ping.sensor < dataset_.sensors.size() && ping.pose < dataset_.poses &&
               ping.pose % dataset_.sensors[ping.sensor].every == 0;
    }

    void copy_ping(const fs::path& part, const PingId& ping) const {
        const DescribedSensor& sensor = dataset_.sensors[ping.sensor];
        for (const std::string& pattern : sensor.files)
            copy_file(part, out_, numbered(pattern, ping.pose));
        for (const std::string& record : sensor.records)
            copy_record(part, out_, record, sensor.pings, ping.pose / sensor.every);
    }

    const std::vector<fs::path>& parts_;
    const fs::path& out_;
    DatasetFile dataset_;  ///< the first part
    CommonFiles common_;
};

void merge_variants(const std::vector<fs::path>& parts, const fs::path& out, const Json& json,
                    const ProgressCallback& progress, const std::atomic<bool>& stop,
                    MergeSummary& summary) {
    for (const fs::path& part : parts)
        require_same_variants(part, json, parts[0]);
    inspect_variants(out, json, {}, false);
    const ShardLock lock(out, 0, 1);
    remove_leftovers(out);
    claim_variants(out, json);
    const std::vector<fs::path> names = folders_of_variants("", json);
    std::uint64_t absent = 0;
    std::uint64_t visited = 0;
    for (std::size_t i = 0; i < names.size() && !summary.stopped; ++i) {
        std::vector<fs::path> sources;
        for (const fs::path& part : parts) {
            require_own_dataset(part, names[i]);
            if (fs::exists(part / names[i] / description_name)) sources.push_back(part / names[i]);
        }
        const fs::path target = out / names[i];
        if (!sources.empty()) DatasetMerge(sources, target).run(stop, summary);
        ++visited;
        if (sources.empty() && is_complete(target))
            summary.skipped += count_pings(require_dataset(target));
        else if (sources.empty())
            ++absent;
        if (stop) summary.stopped = true;
        if (progress) progress(i + 1, names.size());
    }
    if (absent == 0) return;
    summary.complete = false;
    // As many pings as the others have on average.
    const std::uint64_t known = summary.pings + summary.skipped + summary.missing;
    summary.missing +=
        std::max(absent, absent * known / std::max<std::uint64_t>(visited - absent, 1));
}

}  // namespace

MergeSummary merge_parts(const std::vector<fs::path>& parts, const fs::path& out,
                         const ProgressCallback& progress, const std::atomic<bool>& stop) {
    for (const fs::path& part : parts) {
        std::error_code absent;
        if (fs::equivalent(part, out, absent))
            refuse({out.string()}, "is one of the parts; name another folder to write to");
        require_own_dataset(part, "");
    }
    MergeSummary summary;
    summary.complete = true;
    if (const std::optional<Json> json = read_variants(parts.at(0)))
        merge_variants(parts, out, *json, progress, stop, summary);
    else
        DatasetMerge(parts, out).run(stop, summary);
    summary.complete = summary.complete && !summary.stopped;
    return summary;
}

}  // namespace sonarsim
