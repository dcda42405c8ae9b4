#include "gallery/gallery.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "dataset/dataset_file.h"
#include "dataset/layout.h"
#include "gallery/content_policy.h"
#include "gallery/dataset_page.h"
#include "gallery/label_statistics.h"
#include "gallery/members.h"
#include "gallery/page.h"
#include "gallery/unpack.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void replace(std::string& text, std::string_view place, std::string_view by) {
    text.replace(text.find(place), place.size(), by);
}

/// An element with JSON whose text cannot end the element.
std::string json_element(const std::string& id, const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string element = "<script type=\"application/json\" id=\"" + id + "\">";
    element.reserve(element.size() + text.size());
    for (const char c : text)
        c == '<' ? void(element += "\\u003c") : void(element += c);
    return element + "</script>\n";
}

}  // namespace

GallerySummary write_gallery(const fs::path& folder) {
    const PageMembers all = page_members(folder);
    const fs::path file = folder / gallery_name;
    if (fs::exists(fs::symlink_status(file)) && !has_gallery(folder)) {
        throw InputError({file.string()},
                         "is not of sonarsim's making, and would be replaced; move it away");
    }
    GallerySummary summary{.file = file, .datasets = all.members.size()};
    std::vector<std::string> classes;
    std::string elements;
    Json datasets = Json::array();
    bool all_complete = all.missing == 0;
    for (std::size_t k = 0; k < all.members.size(); ++k) {
        const PageMember& member = all.members[k];
        const fs::path inner = folder / member.folder;
        const DatasetFile dataset = require_dataset(inner);
        all_complete = all_complete && dataset.complete;
        const Json json = dataset_json(folder, member.folder, dataset, classes);
        for (const Json& sensor : json.at("sensors"))
            summary.pings += sensor.at("pings").get<std::uint64_t>();
        elements += json_element("dataset-" + std::to_string(k), json);
        datasets.push_back({{"folder", member.folder}, {"facts", member.facts}});
    }
    const Json about = {{"name", all.name},
                        {"missing", all.missing},
                        {"classes", classes},
                        {"axes", statistics_axes_json()},
                        {"statistics", all_complete ? label_statistics(folder) : Json()},
                        {"datasets", std::move(datasets)}};
    std::string page(page_html());
    replace(page, "<!--page.css-->", page_css());
    replace(page, "<!--page.js-->", page_js());
    replace(page, "<!--policy-->", content_policy(page));
    replace(page, "<!--data-->", json_element("page", about) + elements);
    try {
        for (const PageMember& member : all.members)
            unpack_pictures(folder, member.folder, require_dataset(folder / member.folder));
    } catch (const InputError&) {
        remove_gallery_pictures(folder);
        throw;
    }
    write_file(file, page);
    summary.bytes = page.size();
    return summary;
}

}  // namespace sonarsim
