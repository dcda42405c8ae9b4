#include "run/job/variants.h"

#include <tbb/task_arena.h>

#include <exception>
#include <map>
#include <mutex>

#include "core/build_info.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "input/mission/files.h"
#include "input/mission/resolved.h"
#include "output/dataset/metadata.h"
#include "run/checks/find_warnings.h"
#include "run/job/folder.h"
#include "run/job/shard_lock.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
constexpr const char* variants_format = "sonarsim variants";

/// InputError for other variants than expected.
[[noreturn]] void refuse_variants(const fs::path& folder, const std::string& which) {
    refuse({folder.string()},
           "holds variants of another mission, number, seed or version of sonarsim{}", which);
}

/// True if `found` is equal to `json` but may have only the first of its variants.
bool begins(const Json& found, const Json& json) {
    const Json& first = found.at("variants");
    const Json& all = json.at("variants");
    Json rest = found;
    rest["variants"] = all;
    return rest == json && first.size() <= all.size() &&
           std::equal(first.begin(), first.end(), all.begin());
}

/// Removes the variants that variants.json names, then that file, by which a folder is recognised.
void remove_variants(const fs::path& folder, const Mission& mission) {
    const std::optional<Json> found = read_variants(folder);
    if (!found) return;
    for (const fs::path& variant : folders_of_variants(folder, *found)) {
        if (!fs::is_directory(variant)) continue;
        {
            const ShardLock lock(variant, 0, 1);
            remove_dataset(variant, mission);
        }
        if (fs::is_empty(variant)) fs::remove(variant);
    }
    fs::remove(folder / variants_name);
}

/// InputError for a variant whose objects find no room, before any of the variants is written.
void require_places(const Mission& variant, SceneStore& models) {
    if (variant.scene.scatter.empty()) return;
    try {
        check_places(variant, models);
    } catch (const InputError& error) {
        throw InputError(error.what() + (" (in " + variant_folder(variant.variant.index)) + ")");
    }
}

/// The number of pings in the variant's folder, found without its scene; nothing unless it is
/// complete, has all files, and is of this mission, these inputs and a build with the same bytes.
std::optional<std::uint64_t> finished_pings(const Mission& variant, SceneStore& models) try {
    const fs::path& folder = variant.output.folder;
    const DatasetFile found = require_dataset(folder);
    const Json expected = {{"format_version", dataset_format_version},
                           {"program_version", build_info().version},
                           {"build", describe_build()},
                           {"mission_hash", mission_hash(variant, sonar_keys())},
                           {"inputs_hash", found.json.at("inputs_hash")}};
    if (!found.complete || !difference_between(found.json, expected).empty()) return std::nullopt;
    for (const Json& input : found.json.at("inputs")) {
        const fs::path file = home_of(variant) / input.at("file").get<std::string>();
        if (models.sum_of(file) != input.at("sha256").get<std::string>()) return std::nullopt;
    }
    if (!has_files(folder, found)) return std::nullopt;
    tidy(folder, found.json);
    return count_pings(found);
} catch (const std::exception&) {
    return std::nullopt;  // run_job() says what is wrong
}

/// The variants of the shard to render; their objects find room. Counts other pings as skipped.
std::vector<int> unfinished(const Variants& variants, const RenderOptions& options,
                            SceneStore& models, RenderSummary& all) {
    std::vector<int> todo;
    for (int i = options.shard; i < variants.size(); i += options.shards) {
        const Mission variant = variants[i];
        const auto pings =
            options.files && !options.overwrite ? finished_pings(variant, models) : std::nullopt;
        all.skipped += pings.value_or(0);
        if (pings) continue;
        todo.push_back(i);
        require_places(variant, models);
    }
    return todo;
}

/// Renders two variants at a time: while one is assembled or ends, the other uses the threads.
struct VariantQueue {
    static constexpr int none = -1;
    const Variants& variants;
    const std::vector<int>& todo;
    SceneStore& models;
    const VariantCallback& assembled;  ///< called for one variant at a time, in order
    const ProgressCallback& progress;
    RenderSummary& all;
    std::size_t done = 0;
    std::map<int, std::vector<Warning>> warnings = {};
    std::atomic<bool> ended = false;
    std::mutex mutex = {};  ///< guards the models and what follows
    std::size_t next = 0;
    std::map<int, std::exception_ptr> failures = {};

    /// Throws what the first variant that failed has thrown, after those in work have ended.
    void render(const RenderOptions& options, int threads, const std::atomic<bool>& stop) {
        ordered_pipeline(
            todo.size(), std::min(threads, 2), ended,
            [&](std::size_t /*any*/) { return render_next(options, stop); },
            [&](std::pair<int, RenderSummary>& found) { add(found.first, found.second); });
        if (!failures.empty()) std::rethrow_exception(failures.begin()->second);
        for (auto& [index, found] : warnings) {
            for (Warning& warning : found)
                warning.about.insert(0, variant_folder(index) + ": ");
            append(all.warnings, std::move(found));
        }
    }

    std::pair<int, RenderSummary> render_next(const RenderOptions& options,
                                              const std::atomic<bool>& stop) {
        std::unique_lock guard(mutex);
        if (ended) return {none, {}};  // meanwhile
        const int index = todo[next++];
        try {
            const Mission variant = variants[index];
            // Isolated, so that a thread that waits for others does not begin another variant.
            const Assembly assembly =
                tbb::this_task_arena::isolate([&] { return assemble(variant, models); });
            assembled(variant, assembly);
            guard.unlock();
            RenderSummary one = run_job(variant, assembly, options, nullptr, stop);
            append(one.warnings, image_warnings(variant, assembly, one.sensors));
            if (one.stopped) ended = true;
            return {index, std::move(one)};
        } catch (...) {
            if (!guard) guard.lock();
            failures.emplace(index, std::current_exception());
            ended = true;
            return {index, {}};
        }
    }

    void add(int index, RenderSummary& one) {
        if (index == none) return;
        all += one;
        all.complete = all.complete && one.complete;
        all.stopped = all.stopped || one.stopped;
        all.unlocked = all.unlocked || one.unlocked;
        warnings[index] = std::move(one.warnings);
        if (progress) progress(++done, todo.size());
    }
};

}  // namespace

Json describe_variants(const Mission& mission, const Variants& variants) {
    Mission one = mission;  // a variant does not depend on their number
    one.variants = 1;
    Json json = {{"format", variants_format},
                 {"format_version", dataset_format_version},
                 {"program_version", build_info().version},
                 {"mission", mission.name},
                 {"mission_hash", mission_hash(one, sonar_keys())},
                 {"seed", mission.seed}};
    json["variants"] = Json::array();
    for (int i = 0; i < variants.size(); ++i) {
        json["variants"].push_back({{"folder", variant_folder(i)},
                                    {"seed", variants.seed(i)},
                                    {"drawn", describe_drawn(variants.drawn(i))}});
    }
    return json;
}

std::optional<Json> read_variants(const fs::path& folder) {
    const fs::path file = folder / variants_name;
    if (!fs::exists(file)) return std::nullopt;
    Json json = read_json(file);
    if (!json.is_object() || json.value("format", Json()) != variants_format ||
        !json.value("variants", Json()).is_array())
        throw InputError({file.string()}, "is not sonarsim's, or damaged");
    return json;
}

std::vector<fs::path> folders_of_variants(const fs::path& folder, const Json& json) {
    std::vector<fs::path> folders;
    // Names are not taken from the file, so it cannot name anything outside the folder.
    for (std::size_t i = 0; i < json.at("variants").size(); ++i)
        folders.push_back(folder / variant_folder(static_cast<int>(i)));
    return folders;
}

bool is_complete(const fs::path& dataset) {
    if (!fs::exists(dataset / description_name)) return false;
    const std::optional<Json> description = read_description(dataset);
    return description && description->value("complete", Json()) == true;
}

void require_same_variants(const fs::path& folder, const Json& json, const fs::path& first) {
    const std::optional<Json> own = read_variants(folder);
    if (!own)
        throw InputError({folder.string()}, "has no variants.json, and " + first.string() +
                                                " has one; give the output folders of one "
                                                "mission");
    if (*own != json) refuse_variants(folder, " than " + first.string());
}

void inspect_variants(const fs::path& folder, const Json& json, const Variants& variants,
                      bool overwrite) {
    // In this order: another shard may write variants.json at any moment.
    const bool has_files = fs::exists(folder) && !is_unused(folder);
    const std::optional<Json> found = read_variants(folder);
    if (!found && has_files)
        throw InputError({folder.string()},
                         "holds files that are not variants of a sonarsim mission; choose another "
                         "output.folder, or remove it");
    if (found && !begins(*found, json) && !overwrite) {
        std::string difference;
        if (variants.size() > 0)
            difference = mission_differences(folder / variant_folder(0),
                                             resolved_yaml(portable(variants[0]), sonar_keys()));
        refuse_variants(
            folder, difference + "; choose another output.folder, or --overwrite to start again");
    }
    for (const Json& one : {found.value_or(json), json}) {
        for (const fs::path& variant : folders_of_variants(folder, one))
            require_no_link(variant, "a variant");
    }
}

void claim_variants(const fs::path& folder, const Json& json) {
    if (create_once(folder / variants_name, json_text(json))) return;
    inspect_variants(folder, json, {}, false);
    if (read_variants(folder) != json) write_file_durably(folder / variants_name, json_text(json));
}

RenderSummary run_variants(const Mission& mission, const Variants& variants,
                           const RenderOptions& options, const VariantCallback& begin,
                           const ProgressCallback& progress, const std::atomic<bool>& stop) {
    check(options);
    const fs::path& folder = mission.output.folder;
    const Json json = describe_variants(mission, variants);
    if (options.files) inspect_variants(folder, json, variants, options.overwrite);
    RenderSummary all;
    SceneStore models;
    const std::vector<int> todo = unfinished(variants, options, models, all);
    std::optional<ShardLock> lock;
    const auto enter = [&] {
        lock.emplace(folder, options.shard, options.shards);
        all.unlocked = !lock->works();
        if (options.overwrite) remove_variants(folder, variants[0]);
        claim_variants(folder, json);
    };
    all.complete = options.files;
    Stopwatch watch;
    const RenderOptions one_by_one{
        .threads = options.threads, .files = options.files, .checkpoint_s = options.checkpoint_s};
    const auto assembled = [&](const Mission& variant, const Assembly& assembly) {
        if (begin) begin(variant, assembly);
        if (options.files && !lock) enter();  // once the first scene has been read
    };
    on_threads(options.threads, [&](int threads) {
        VariantQueue{variants, todo, models, assembled, progress, all}.render(one_by_one, threads,
                                                                              stop);
    });
    if (options.files) {
        // A shard without a variant makes its folder, too: merge takes those of all shards.
        if (!lock && read_variants(folder) != json) enter();
        lock.reset();
        tidy(folder, Json::object());  // runs were killed
    }
    for (int i = 0; i < variants.size() && all.complete; ++i)
        all.complete = is_complete(folder / variant_folder(i));
    all.seconds = watch.lap();
    return all;
}

}  // namespace sonarsim
