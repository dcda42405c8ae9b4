#include "job/collection.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "core/sha256.h"
#include "core/text.h"
#include "dataset/coco/join.h"
#include "dataset/dataset_file.h"
#include "dataset/layout.h"
#include "dataset/ping_metadata.h"
#include "job/checksums.h"
#include "job/folder.h"
#include "job/folder_lock.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A dataset that is to be collected.
struct Member {
    fs::path from;
    DatasetFile description;
    std::map<std::string, std::string> sums;  ///< SHA-256 by file
    std::string folder;                       ///< its name in the collection
};

/// InputError unless the mission's name is plain text: it names a folder in SHA256SUMS.
void require_printable(const fs::path& from, const std::string& mission) {
    if (printable(mission) == mission) return;
    throw InputError({(from / description_name).string()},
                     "'mission' is \"" + printable(mission) +
                         "\" and must be plain text to be the name of a folder");
}

Member read_member(const fs::path& from) {
    const fs::path sums = from / checksums_name;
    DatasetFile description = require_dataset(from);
    require_printable(from, description.mission);
    if (!description.complete || !fs::is_regular_file(sums)) {
        throw InputError({from.string()},
                         "is not complete, and only whole datasets can stand side by side; render "
                         "what is missing, or merge its shards first");
    }
    Member member{from, std::move(description), read_checksums(sums), {}};
    for (const auto& [name, sum] : member.sums) {
        if (!fs::is_regular_file(from / name)) {
            throw InputError(
                {(from / name).string()},
                "is missing, and SHA256SUMS lists it; sonarsim verify says what to do");
        }
    }
    member.sums[checksums_name] = sha256_of_file(sums);
    return member;
}

/// Reads the datasets and sorts them, so that the order of `parts` does not matter. Each gets a
/// folder. InputError when a dataset is there twice.
std::vector<Member> read_members(const std::vector<fs::path>& parts) {
    std::vector<Member> members;
    members.reserve(parts.size());
    for (const fs::path& part : parts)
        members.push_back(read_member(part));
    const auto key = [](const Member& member) {
        const DatasetFile& d = member.description;
        return std::tuple(d.mission, d.mission_hash, d.inputs_hash);
    };
    std::ranges::stable_sort(members, {}, key);
    std::set<std::string> taken{collection_name, checksums_name, labels_folder_name, gallery_name,
                                gallery_folder_name};
    for (std::size_t k = 0; k < members.size(); ++k) {
        Member& member = members[k];
        if (k > 0 && key(members[k - 1]) == key(member)) {
            throw InputError({member.from.string()}, "is the same dataset as " +
                                                         members[k - 1].from.string() +
                                                         "; name each of them once");
        }
        const std::string name = std::get<0>(key(member));
        member.folder = name;
        for (int other = 2; !taken.insert(member.folder).second; ++other)
            member.folder = name + "-" + std::to_string(other);
    }
    return members;
}

Json describe(const std::vector<Member>& members) {
    std::set<std::string> class_names;
    for (const Member& member : members) {
        const std::vector<std::string>& classes = member.description.labels.classes;
        class_names.insert(classes.begin(), classes.end());
    }
    Json json = {{"format", collection_format},
                 {"format_version", collection_format_version},
                 {"complete", false}};
    std::map<std::string, std::uint64_t> class_ids;
    json["classes"] = Json::array();
    for (const std::string& name : class_names) {
        const std::uint64_t id = class_ids.size() + 1;
        class_ids.emplace(name, id);
        json["classes"].push_back({{"id", id}, {"name", name}});
    }
    std::uint64_t offset = 0;
    json["datasets"] = Json::array();
    for (const Member& member : members) {
        Json classes = Json::object();
        const DescribedLabels& labels = member.description.labels;
        for (std::size_t k = 0; k < labels.classes.size(); ++k)
            classes[std::to_string(k + 1)] = class_ids.at(labels.classes[k]);
        json["datasets"].push_back({{"folder", member.folder},
                                    {"mission", member.description.mission},
                                    {"mission_hash", member.description.mission_hash},
                                    {"seed", member.description.seed},
                                    {"sha256sums", member.sums.at(checksums_name)},
                                    {"instance_id_offset", offset},
                                    {"class_ids", std::move(classes)}});
        offset += labels.instances.size();
    }
    return json;
}

std::vector<std::string> seeds_shared_by(const std::vector<Member>& members) {
    std::map<std::string, std::vector<std::string>> by_seed;
    for (const Member& member : members)
        by_seed[std::to_string(member.description.seed)].push_back(member.folder);
    std::vector<std::string> warnings;
    for (const auto& [seed, folders] : by_seed) {
        if (folders.size() < 2) continue;
        std::string names;
        for (const std::string& folder : folders)
            names += (names.empty() ? "" : ", ") + folder;
        warnings.push_back("the datasets of seed " + seed + " (" + names +
                           ") have the same noise, bit for bit, in every bin without an echo: to "
                           "train with one and test with another is a leak; render each with a "
                           "seed of its own, or keep them on the same side");
    }
    return warnings;
}

/// Refuses symbolic links below `out`.
void require_no_links(const fs::path& out, const std::vector<Member>& members) {
    std::set<fs::path> folders;
    for (const Member& member : members) {
        for (const auto& [name, sum] : member.sums) {
            for (fs::path path = fs::path(member.folder) / name; path.has_parent_path();
                 path = path.parent_path())
                folders.insert(path.parent_path());
        }
    }
    folders.insert(labels_folder_name);
    for (const fs::path& folder : folders)
        require_no_link(out / folder, "a collection");
}

/// Locks the folder, and begins the collection unless the folder holds it.
FolderLock begin_collection(const fs::path& out, const Json& description) {
    FolderLock lock = lock_alone(out);
    if (std::optional<CollectionFile> found = read_collection(out)) {
        found->json["complete"] = false;
        if (found->json == description) return lock;
        throw InputError({out.string()},
                         "holds a collection of other datasets; choose another folder");
    }
    if (!is_unused(out)) throw InputError({out.string()}, "is not empty; choose another folder");
    write_file_durably(out / collection_name, json_text(description));
    return lock;
}

/// Writes the COCO files of all datasets together. Returns their lines of SHA256SUMS.
std::string write_labels(const fs::path& out, const std::vector<Member>& members,
                         const Json& description) {
    std::vector<CocoMember> joined;
    for (const Member& member : members)
        joined.push_back(coco_member(member.description, member.folder, SplitPart::none));
    std::vector<std::string> classes;
    for (const Json& one : description.at("classes"))
        classes.push_back(one.at("name"));
    write_joined_labels(out, joined, classes, collection_format);
    std::string sums;
    for (const std::string& file : joined_label_files(joined))
        sums += checksum_line(sha256_of_file(out / file), file);
    return sums;
}

/// Returns false when the file was there already.
bool copy_whole(const fs::path& from, const fs::path& to, const std::string& sum) {
    if (fs::is_regular_file(to) && sha256_of_file(to) == sum) return false;
    fs::create_directories(to.parent_path());
    AtomicFile copy(to);
    fs::copy_file(from, copy.part());
    if (sha256_of_file(copy.part()) != sum) {
        throw InputError({from.string()},
                         "differs from its SHA256SUMS; sonarsim verify says what to do");
    }
    copy.commit();
    return true;
}

}  // namespace

CollectionSummary collect_datasets(const std::vector<fs::path>& parts, const fs::path& out,
                                   int threads, const ProgressCallback& progress,
                                   const std::atomic<bool>& stop) {
    const std::vector<Member> members = read_members(parts);
    Json description = describe(members);
    const FolderLock lock = begin_collection(out, description);
    require_no_links(out, members);
    struct Copy {
        fs::path from, to;
        std::string sum;
    };
    std::vector<Copy> copies;
    std::string sums;
    std::set<fs::path> folders{out, out / labels_folder_name};
    for (const Member& member : members) {
        for (const auto& [name, sum] : member.sums) {
            copies.push_back({member.from / name, out / member.folder / name, sum});
            folders.insert(copies.back().to.parent_path());
            sums += checksum_line(sum, member.folder + "/" + name);
        }
    }
    std::ranges::for_each(folders, remove_temporary_files);
    CollectionSummary summary{.warnings = seeds_shared_by(members)};
    if (!lock.works()) summary.warnings.push_back(sentence(no_locks_warning(out)));
    on_threads(threads, [&](int n) {
        ordered_pipeline(
            copies.size(), 2 * static_cast<std::size_t>(n), stop,
            [&](std::size_t i) { return copy_whole(copies[i].from, copies[i].to, copies[i].sum); },
            [&](bool copied) {
                ++(copied ? summary.files : summary.skipped);
                if (progress) progress(summary.files + summary.skipped, copies.size());
            });
    });
    if (summary.files + summary.skipped < copies.size()) return summary;
    sums += write_labels(out, members, description);
    description["complete"] = true;
    const std::string text = json_text(description);
    sync_file_system(out);
    write_file_durably(out / checksums_name, sums + checksum_line(sha256(text), collection_name));
    write_file_durably(out / collection_name, text);
    summary.complete = true;
    return summary;
}

}  // namespace sonarsim
