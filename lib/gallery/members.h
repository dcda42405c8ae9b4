#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sonarsim {

/// A dataset on the page.
struct PageMember {
    std::string folder;            ///< relative to that of the page: "variant_0003"; "": the same
    nlohmann::ordered_json facts;  ///< texts by name, which set it apart: part of the split, draws
};

/// The datasets in a folder.
struct PageMembers {
    std::string name;  ///< the name of the mission or collection
    std::vector<PageMember> members;
    std::size_t missing = 0;  ///< variants that no run has begun
};

/// Looks for a dataset, the variants of a mission, or a collection. InputError when the folder
/// holds none of these, or none of its variants is begun.
PageMembers page_members(const std::filesystem::path& folder);

}  // namespace sonarsim
