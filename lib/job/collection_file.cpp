#include "job/collection_file.h"

#include "core/error.h"
#include "core/text.h"
#include "dataset/checked_json.h"
#include "mission/schema.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_collection = std::size_t{1} << 28;

}  // namespace

std::optional<CollectionFile> read_collection(const std::filesystem::path& folder) {
    const std::string file = (folder / collection_name).string();
    if (!std::filesystem::is_regular_file(file)) return std::nullopt;
    CollectionFile collection{read_json(file, largest_collection), false, {}};
    const CheckedJson root(collection.json, file);
    if (root.at("format").text() != collection_format)
        throw InputError({file}, "is not sonarsim's, or damaged");
    root.at("format_version").whole(collection_format_version, collection_format_version);
    collection.complete = root.at("complete").flag();
    for (const CheckedJson& dataset : root.at("datasets").items()) {
        const CheckedJson name = dataset.at("folder");
        collection.folders.push_back(name.text());
        const std::string& told = collection.folders.back();
        if (!is_folder_name(told) || printable(told) != told)
            name.refuse("the name of one folder in that of the collection");
    }
    return collection;
}

}  // namespace sonarsim
