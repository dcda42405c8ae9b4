#include "dataset/coco/join.h"

#include <algorithm>

#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/coco/reader.h"
#include "dataset/coco/statistics.h"
#include "dataset/file_names.h"
#include "dataset/shared_products.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view json_end = ".json";

/// The members' files that make each joined file: pairs of the index of a member and a file name.
using JoinedFiles = std::map<std::string, std::vector<std::pair<std::size_t, std::string>>>;

JoinedFiles joined_files(std::span<const CocoMember> members) {
    JoinedFiles files;
    for (std::size_t k = 0; k < members.size(); ++k) {
        for (const std::string& file : members[k].files) {
            files[file].emplace_back(k, file);
            if (members[k].part == SplitPart::none) continue;
            const std::string stem = file.substr(0, file.size() - json_end.size());
            const auto part = split_part_names[static_cast<std::size_t>(members[k].part)];
            files[stem + "_" + std::string(part) + std::string(json_end)].emplace_back(k, file);
        }
    }
    return files;
}

/// A copy of an item with other values; keys stay in their order.
Json with(const CheckedJson& item, const Json& changed) {
    Json copy = item.json();
    copy.update(changed);
    return copy;
}

/// The image of a member, with its id and its path in the joined file.
Json joined_image(const CheckedJson& image, const CocoMember& member, std::uint64_t offset) {
    const CheckedJson name = image.at("file_name");
    if (!is_inner_path(name.text())) name.refuse("the path of a file in the dataset");
    return with(image, {{"id", offset + image.at("id").whole(1, member.image_ids)},
                        {"file_name", member.folder + "/" + name.text()}});
}

Json joined_annotation(const CheckedJson& annotation, const CocoMember& member,
                       std::uint64_t offset,
                       const std::map<std::string, std::uint64_t>& category_ids) {
    const std::uint64_t id =
        annotation.at("id").whole(1, ids_per_image * (member.image_ids + 1) - 1);
    const std::uint64_t category = annotation.at("category_id").whole(1, member.classes.size());
    return with(annotation,
                {{"id", ids_per_image * offset + id},
                 {"image_id", offset + annotation.at("image_id").whole(1, member.image_ids)},
                 {"category_id", category_ids.at(member.classes[category - 1])}});
}

std::vector<std::string> all_coco_files() {
    std::vector<std::string> names;
    for (const CocoPicture picture :
         {CocoPicture::polar, CocoPicture::fan, CocoPicture::record, CocoPicture::scan}) {
        names.push_back(coco_file(picture));
        for (const std::string_view part : split_part_names)
            names.push_back(coco_file(picture, "_" + std::string(part)));
    }
    return names;
}

}  // namespace

CocoMember coco_member(const DatasetFile& dataset, const std::string& folder, SplitPart part) {
    CocoMember member{folder,
                      part,
                      dataset.json.at("program_version").get<std::string>(),
                      dataset.labels.classes,
                      {},
                      {},
                      0};
    const std::string name = folder + "/" + description_name;
    if (dataset.json.contains("labels"))
        member.rules = annotation_rules({dataset.json["labels"], name});
    const std::vector<std::string> known = all_coco_files();
    for (const std::string& file : dataset.products) {
        if (std::ranges::find(known, file) != known.end()) member.files.push_back(file);
    }
    // Count ids as write_coco(), write_record_coco() and write_scan_coco() do. A picture of records
    // needs ids for as many annotations as it may have.
    member.image_ids = 2 + 2 * dataset.sensors.size();
    const auto& sensors = dataset.json.at("sensors");
    for (std::size_t i = 0; i < dataset.sensors.size(); ++i) {
        const std::uint64_t pings = dataset.sensors[i].pings;
        member.image_ids += 2 * pings;
        if (!sensors[i].contains("scan")) continue;
        const auto per_sweep = sensors[i]["scan"]["pings_per_sweep"].get<std::uint64_t>();
        member.image_ids += (pings + per_sweep - 1) / per_sweep;
    }
    return member;
}

std::vector<std::string> joined_label_files(std::span<const CocoMember> members) {
    std::vector<std::string> names;
    for (const auto& [name, sources] : joined_files(members))
        names.push_back(name);
    if (!names.empty()) names.emplace_back(statistics_name);
    return names;
}

std::vector<std::string> all_joined_label_files() {
    std::vector<std::string> names = all_coco_files();
    names.emplace_back(statistics_name);
    return names;
}

std::vector<std::string> classes_of(std::span<const CocoMember> members) {
    std::vector<std::string> classes;
    for (const CocoMember& member : members) {
        for (std::size_t k = 0; k < member.classes.size(); ++k) {
            const std::string& name = member.classes[k];
            const bool is_new = std::ranges::find(classes, name) == classes.end();
            if (is_new && !member.rules.is_background(k)) classes.push_back(name);
        }
    }
    return classes;
}

void write_joined_labels(const fs::path& folder, std::span<const CocoMember> members,
                         const std::vector<std::string>& classes, const std::string& description) {
    if (members.empty()) return;
    Json info = {{"mission", description}, {"program_version", members.front().program_version}};
    std::map<std::string, std::uint64_t> category_ids;
    info["labels"]["classes"] = Json::array();
    const std::vector<std::string> annotated = classes_of(members);
    for (const std::string& name : classes) {
        const std::uint64_t id = category_ids.size() + 1;
        category_ids.emplace(name, id);
        if (std::ranges::find(annotated, name) != annotated.end())
            info["labels"]["classes"].push_back({{"id", id}, {"name", name}});
    }
    std::vector<std::uint64_t> offsets{0};
    for (const CocoMember& member : members)
        offsets.push_back(offsets.back() + member.image_ids);
    std::vector<std::string> written;
    for (const auto& [name, sources] : joined_files(members)) {
        written.push_back(name);
        fs::create_directories((folder / name).parent_path());
        CocoFile out(folder / name, info);
        for (const char* const list : {"images", "annotations"}) {
            const bool is_images = list == std::string_view("images");
            out.begin_list(list);
            for (const auto& [k, file] : sources) {
                const CocoMember& member = members[k];
                const std::uint64_t offset = offsets[k];
                read_coco(folder / member.folder / file, list, [&](const CheckedJson& item) {
                    out.add(is_images ? joined_image(item, member, offset)
                                      : joined_annotation(item, member, offset, category_ids));
                });
            }
            out.end_list();
        }
        out.finish();
    }
    if (!written.empty()) write_statistics(folder, written, true);
}

}  // namespace sonarsim
