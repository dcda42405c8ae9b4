#include "core/error.h"
#include "core/sha256.h"
#include "core/text.h"
#include "dataset/checked_json.h"
#include "dataset/layout.h"
#include "job/checksums.h"
#include "job/collection.h"
#include "mission/schema.h"

namespace sonarsim {

namespace fs = std::filesystem;

std::optional<CollectionFile> read_collection(const fs::path& folder) {
    constexpr std::size_t largest = std::size_t{1} << 28;
    const std::string file = (folder / collection_name).string();
    if (!fs::is_regular_file(file)) return std::nullopt;
    CollectionFile collection{read_json(file, largest), false, {}};
    const CheckedJson root(collection.json, file);
    if (root.at("format").text() != collection_format)
        throw InputError({file}, "is not sonarsim's, or damaged");
    root.at("format_version").whole(collection_format_version, collection_format_version);
    collection.complete = root.at("complete").flag();
    for (const CheckedJson& dataset : root.at("datasets").items()) {
        const CheckedJson name = dataset.at("folder");
        const std::string& text = collection.folders.emplace_back(name.text());
        if (!is_folder_name(text) || printable(text) != text)
            name.refuse("the name of one folder in that of the collection");
    }
    return collection;
}

std::vector<fs::path> collected_folders(const fs::path& folder) {
    std::vector<fs::path> folders;
    if (const std::optional<CollectionFile> collection = read_collection(folder)) {
        for (const std::string& name : collection->folders)
            folders.push_back(folder / name);
    }
    return folders;
}

std::vector<std::string> collection_errors(const fs::path& folder) {
    const std::optional<CollectionFile> collection = read_collection(folder);
    if (!collection || !collection->complete) {
        return {std::string(collection_name) +
                ": is not complete; the merge command that made it, run again, goes on"};
    }
    const std::string cure =
        "; the merge command that made the collection, run into an empty folder, makes it anew";
    const fs::path sums_file = folder / checksums_name;
    if (!fs::is_regular_file(sums_file))
        return {std::string(checksums_name) + ": is missing" + cure};
    auto sums = read_checksums(sums_file);
    std::vector<std::string> errors;
    const auto check = [&](const std::string& name, const std::string& sum) {
        const auto listed = sums.extract(name);
        if (listed.empty()) {
            errors.push_back(name + ": SHA256SUMS of the collection does not list it" + cure);
        } else if (listed.mapped() != sum) {
            errors.push_back(name + ": differs from SHA256SUMS of the collection" + cure);
        }
    };
    check(collection_name, sha256_of_file(folder / collection_name));
    for (const fs::path& dataset : collected_folders(folder)) {
        const std::string prefix = dataset.filename().string() + "/";
        const fs::path own = dataset / checksums_name;
        // verify_dataset() reports a missing one.
        if (!fs::is_regular_file(own)) continue;
        check(prefix + checksums_name, sha256_of_file(own));
        for (const auto& [name, sum] : read_checksums(own))
            check(prefix + name, sum);
    }
    for (const auto& [name, sum] : sums) {
        if (fs::is_regular_file(folder / name)) {
            const bool is_joined = name.starts_with(std::string(labels_folder_name) + "/");
            if (is_joined && sha256_of_file(folder / name) != sum)
                errors.push_back(name + ": differs from SHA256SUMS of the collection" + cure);
            continue;
        }
        errors.push_back(name + ": is missing, and SHA256SUMS of the collection lists it" + cure);
    }
    return errors;
}

}  // namespace sonarsim
