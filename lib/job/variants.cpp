#include "job/variants.h"

#include <algorithm>

#include "checks/find_warnings.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/file.h"
#include "core/sha256.h"
#include "core/text.h"
#include "dataset/checked_json.h"
#include "dataset/description.h"
#include "dataset/layout.h"
#include "dataset/metadata.h"
#include "dataset/ping_metadata.h"
#include "job/checksums.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/variant_inputs.h"
#include "mission/resolved.h"
#include "mission/variants.h"
#include "scene/gltf/scene_files.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* variants_format = "sonarsim variants";
constexpr std::size_t largest_index = std::size_t{1} << 30;

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& what) {
    throw InputError({folder.string()},
                     what + "; choose another output.folder, or --overwrite to begin anew");
}

/// Removes the dataset of a variant, and its folder if that is empty then.
void remove_variant(const fs::path& folder, const Mission& mission) {
    if (!fs::is_directory(folder)) return;
    const FolderLock lock = lock_alone(folder);
    Layout layout;
    layout.folder = folder;
    remove_dataset(layout, mission);
    if (fs::is_empty(folder)) fs::remove(folder);
}

/// Removes the files that all variants share. variants.json stays: the folder is recognised by it.
void remove_common_files(const fs::path& folder) {
    fs::remove(folder / checksums_name);
    remove_gallery(folder);  // it shows files that are gone
}

/// Writes a file only if it differs: the disk of a complete dataset may be read-only.
void keep_or_write(const fs::path& file, const std::string& text) {
    if (fs::is_regular_file(file) && read_file(file, largest_index) == text) return;
    fs::create_directories(file.parent_path());
    write_file_durably(file, text);
}

/// Writes variants.json and its sum.
void write_common_files(const fs::path& folder, const Json& json) {
    const std::string text = json_text(json);
    keep_or_write(folder / variants_name, text);
    keep_or_write(folder / checksums_name, checksum_line(sha256(text), variants_name));
}

/// Locks the folder of all variants for a run and prepares it. Shards share the lock; the others
/// wait while one of them prepares the folder.
FolderLock enter(const fs::path& folder, const Json& json, std::span<const Mission> variants,
                 const RenderOptions& options) {
    constexpr double longest_s = 10.0;
    const bool alone = options.shards == 1;
    const auto waits = [&, watch = Stopwatch(), waited_s = 0.0]() mutable {
        return !alone && (waited_s += watch.lap()) < longest_s;
    };
    FolderLock lock(folder);
    const bool entered = alone ? lock.take_alone(waits) : lock.take_alone_or_share(waits);
    if (!entered) refuse_second_run(folder);
    begin_variants(folder, json, variants, options.overwrite);
    // Another run may come in between, and then the folder may hold other variants.
    if (!alone && (!lock.share(waits) || read_variants(folder) != json)) refuse_second_run(folder);
    return lock;
}

void add(RenderSummary& all, const RenderSummary& one) {
    all.pings += one.pings;
    all.skipped += one.skipped;
    all.complete = all.complete && one.complete;
    all.unlocked = all.unlocked || one.unlocked;
    all.seconds += one.seconds;
    all.stages += one.stages;
    all.encode_seconds += one.encode_seconds;
    all.write_seconds += one.write_seconds;
    all.counts += one.counts;
    all.clipped_pixels += one.clipped_pixels;
    all.sensors.resize(std::max(all.sensors.size(), one.sensors.size()));
    for (std::size_t i = 0; i < one.sensors.size(); ++i)
        all.sensors[i] += one.sensors[i];
}

/// InputError for the keys of variants.json that are read; the others are only compared.
void check_variants(const Json& json, const std::string& file) {
    int index = 0;
    for (const CheckedJson& variant : CheckedJson(json, file).at("variants").items()) {
        const std::string name = variant_folder(index++);
        if (variant.at("folder").text() != name) variant.at("folder").refuse("\"" + name + '"');
    }
}

/// Refuses links: nothing outside the folder is written or removed.
void require_no_links(const fs::path& folder, const Json& json) {
    for (const fs::path& one : folders_of_variants(folder, json))
        require_no_link(one, "a variant");
}

}  // namespace

Json describe_variants(const Mission& mission, std::span<const Mission> variants) {
    Json json = {{"format", variants_format},
                 {"format_version", dataset_format_version},
                 {"program_version", SONARSIM_VERSION},
                 {"mission", mission.name},
                 {"mission_hash", mission_hash(mission, sonar_keys())},
                 {"seed", mission.seed}};
    json["variants"] = Json::array();
    for (const Mission& variant : variants) {
        json["variants"].push_back({{"folder", variant_folder(variant.variant.index)},
                                    {"seed", variant.seed},
                                    {"drawn", describe_drawn(variant.variant.drawn)}});
    }
    return json;
}

std::optional<Json> read_variants(const fs::path& folder) {
    const fs::path file = folder / variants_name;
    if (!fs::exists(file)) return std::nullopt;
    Json json = read_json(file, largest_index);
    if (!json.is_object() || json.value("format", Json()) != variants_format)
        throw InputError({file.string()}, "is not sonarsim's, or damaged");
    check_variants(json, file.string());
    return json;
}

std::vector<fs::path> folders_of_variants(const fs::path& folder, const Json& json) {
    std::vector<fs::path> folders;
    const Json variants = json.value("variants", Json::array());
    // Names are not taken from the file, so it cannot name anything outside the folder.
    for (std::size_t i = 0; i < variants.size(); ++i)
        folders.push_back(folder / variant_folder(static_cast<int>(i)));
    return folders;
}

bool is_complete(const fs::path& dataset) {
    if (!fs::exists(dataset / description_name)) return false;
    const std::optional<Json> description = read_description(dataset);
    return description && description->value("complete", Json()) == true;
}

std::optional<Json> inspect_variants(const fs::path& folder, const Json& json,
                                     std::span<const Mission> variants, bool overwrite) {
    // In this order: another shard may write variants.json at any moment.
    const bool has_files = fs::exists(folder) && !is_unused(folder);
    std::optional<Json> found = read_variants(folder);
    if (!found && has_files)
        throw InputError({folder.string()},
                         "holds files that are no variants of a sonarsim mission; choose another "
                         "output.folder, or remove it");
    if (found && *found != json && !overwrite) {
        std::string difference = variants_difference(*found, json);
        if (difference.empty() && !variants.empty())
            difference =
                mission_differences(folder / variant_folder(0),
                                    resolved_yaml(portable(variants.front()), sonar_keys()));
        refuse_folder(
            folder, "holds variants of another mission, seed or version of sonarsim" + difference);
    }
    if (found) require_no_links(folder, *found);
    require_no_links(folder, json);
    return found;
}

void begin_variants(const fs::path& folder, const Json& json, std::span<const Mission> variants,
                    bool overwrite) {
    const std::optional<Json> found = inspect_variants(folder, json, variants, overwrite);
    if (found && overwrite) {
        for (const fs::path& old : folders_of_variants(folder, *found))
            remove_variant(old, variants.front());
        remove_common_files(folder);
    }
    write_common_files(folder, json);
}

void finish_variants(const fs::path& folder, const Json& json) {
    // Shards that began at the same time did not see each other.
    require_same_inputs(folders_of_variants(folder, json));
}

namespace {

/// InputError for a variant whose objects find no room, before any of the variants is written.
void require_places(std::span<const Mission> variants, bool files) {
    SceneFiles models;
    for (const Mission& variant : variants) {
        if (variant.scene.scatter.empty() || (files && is_complete(variant.output.folder)))
            continue;
        try {
            check_places(variant, models);
        } catch (const InputError& error) {
            throw InputError(error.what() + (" (in " + variant_folder(variant.variant.index)) +
                             ")");
        }
    }
}

}  // namespace

RenderSummary run_variants(const Mission& mission, std::span<const Mission> variants,
                           const RenderOptions& options, const VariantCallback& begin,
                           const ProgressCallback& progress, const std::atomic<bool>& stop) {
    check(options);
    const fs::path& folder = mission.output.folder;
    const Json json = describe_variants(mission, variants);
    require_places(variants, options.files);
    std::optional<FolderLock> lock;
    RenderOptions one_by_one = options;
    one_by_one.shard = 0;
    one_by_one.shards = 1;
    one_by_one.overwrite = false;  // enter() has done that
    SceneFiles models;
    RenderSummary all;
    all.complete = options.files;
    Stopwatch watch;
    const auto is_ours = [&](std::size_t i) {
        return static_cast<int>(i % static_cast<std::size_t>(options.shards)) == options.shard;
    };
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < variants.size(); ++i)
        total += is_ours(i);
    std::uint64_t done = 0;
    for (std::size_t i = 0; i < variants.size() && !all.stopped; ++i) {
        if (!is_ours(i)) continue;
        const std::string name = variant_folder(static_cast<int>(i)) + ": ";
        const Assembly assembly = assemble(variants[i], models);
        if (begin) begin(variants[i], assembly);
        if (options.files && !lock) {
            // InputError before anything is written.
            const std::vector<Writers> writers = make_writers(variants[i], assembly);
            const Layout layout = make_layout(variants[i], writers, assembly.trajectory.size());
            protect_inputs(layout, variants[i]);
            lock.emplace(enter(folder, json, variants, options));
            // The variants of other shards: run_job() compares those of this one.
            require_same_inputs(folders_of_variants(folder, json),
                                describe_dataset(variants[i], assembly, layout, writers));
            all.unlocked = !lock->works();
        }
        const RenderSummary one = run_job(variants[i], assembly, one_by_one, nullptr, stop);
        add(all, one);
        all.stopped = one.stopped;
        for (std::vector<Warning> found :
             {one.warnings, image_warnings(variants[i], assembly, one.sensors)}) {
            for (Warning& warning : found) {
                warning.about.insert(0, name);
                all.warnings.push_back(std::move(warning));
            }
        }
        if (progress) progress(++done, total);
    }
    // A shard without a variant makes its folder, too: merge takes those of all shards.
    if (options.files && !lock) lock.emplace(enter(folder, json, variants, options));
    for (std::size_t i = 0; i < variants.size(); ++i)
        all.complete = all.complete && (is_ours(i) || is_complete(variants[i].output.folder));
    if (all.complete) finish_variants(folder, json);
    all.seconds = watch.lap();
    return all;
}

}  // namespace sonarsim
