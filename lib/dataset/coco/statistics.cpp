#include "dataset/coco/statistics.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/file.h"
#include "dataset/checked_json.h"
#include "dataset/coco/reader.h"
#include "dataset/ping_metadata.h"
#include "dataset/shared_products.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_count = std::uint64_t{1} << 52;
constexpr std::size_t largest_file = std::size_t{1} << 28;

constexpr std::array range_edges{1.0,  1.5,  2.0,   3.0,   5.0,   7.0,   10.0,  15.0,  20.0,  30.0,
                                 50.0, 70.0, 100.0, 150.0, 200.0, 300.0, 500.0, 700.0, 1000.0};
constexpr std::array area_edges{4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0, 16384.0, 65536.0};
constexpr std::array share_edges{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
constexpr std::array contrast_edges{-12.0, -9.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0};

constexpr std::array<StatisticsAxis, statistics_axes> axes{
    StatisticsAxis{"range_m", "range, m", range_edges},
    StatisticsAxis{"area", "pixels", area_edges},
    StatisticsAxis{"visible_share", "visible share", share_edges},
    StatisticsAxis{"contrast_db", "contrast, dB", contrast_edges}};

/// An object: the folder of its dataset among others, and its id there.
using ObjectKey = std::pair<std::string, std::uint64_t>;

/// A class while it is counted.
struct ClassCount {
    ClassTally tally;
    std::set<ObjectKey> objects;
    std::set<std::uint64_t> pictures;
};

/// The pictures of a COCO file while they are counted.
struct PictureCount {
    std::uint64_t pictures = 0;
    std::set<std::uint64_t> with_objects;  ///< their ids, which are unique in a dataset
    std::vector<ClassCount> classes;

    ClassCount& class_named(const std::string& name) {
        const auto found =
            std::ranges::find(classes, name, [](const ClassCount& one) { return one.tally.name; });
        if (found != classes.end()) return *found;
        ClassCount& added = classes.emplace_back();
        added.tally.name = name;
        for (std::size_t k = 0; k < axes.size(); ++k)
            added.tally.histograms[k].resize(axes[k].edges.size() + 1);
        return added;
    }
};

void add_annotation(const CheckedJson& annotation, const std::string& member, ClassCount& count) {
    const auto crowd = annotation.find("iscrowd");
    if (crowd && crowd->whole(0, 1) == 1) {
        ++count.tally.ignored;
        return;
    }
    ++count.tally.annotations;
    count.objects.emplace(member, annotation.at("instance_id").whole(1, largest_count));
    count.pictures.insert(annotation.at("image_id").whole(1, largest_count));
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const auto value = annotation.find(axes[k].key);
        if (!value || value->json().is_null()) continue;
        const auto above = std::ranges::upper_bound(axes[k].edges, value->number());
        ++count.tally.histograms[k][static_cast<std::size_t>(above - axes[k].edges.begin())];
    }
}

/// Adds a COCO file to each of `counts`.
void add_coco(const fs::path& file, bool joined, const std::vector<PictureCount*>& counts) {
    std::map<std::uint64_t, std::string> classes;
    read_coco(file, "categories", [&](const CheckedJson& category) {
        const std::string name = category.at("name").text();
        classes[category.at("id").whole(1, largest_count)] = name;
        for (PictureCount* count : counts)
            count->class_named(name);
    });
    std::map<std::uint64_t, std::string> members;  // folders of datasets by the id of an image
    read_coco(file, "images", [&](const CheckedJson& image) {
        const std::string name = image.at("file_name").text();
        members[image.at("id").whole(1, largest_count)] =
            joined ? name.substr(0, name.find('/')) : std::string();
        for (PictureCount* count : counts)
            ++count->pictures;
    });
    read_coco(file, "annotations", [&](const CheckedJson& annotation) {
        const CheckedJson image = annotation.at("image_id");
        const CheckedJson category = annotation.at("category_id");
        const auto member = members.find(image.whole(1, largest_count));
        const auto name = classes.find(category.whole(1, largest_count));
        if (member == members.end()) image.refuse("the id of an image above");
        if (name == classes.end()) category.refuse("the id of a category above");
        for (PictureCount* count : counts) {
            ClassCount& of_class = count->class_named(name->second);
            const std::uint64_t before = of_class.tally.annotations;
            add_annotation(annotation, member->second, of_class);
            if (of_class.tally.annotations > before) count->with_objects.insert(member->first);
        }
    });
}

PictureTally tally_of(const PictureCount& count) {
    PictureTally tally{count.pictures, count.pictures - count.with_objects.size(), {}};
    for (const ClassCount& one : count.classes) {
        ClassTally& added = tally.classes.emplace_back(one.tally);
        added.objects = one.objects.size();
        added.pictures = one.pictures.size();
    }
    return tally;
}

PictureTally tally_of(const CheckedJson& json) {
    PictureTally tally;
    tally.pictures = json.at("pictures").whole(0, largest_count);
    tally.without_objects = json.at("without_objects").whole(0, tally.pictures);
    for (const CheckedJson& one : json.at("classes").items()) {
        ClassTally& of_class = tally.classes.emplace_back();
        of_class.name = one.at("name").text();
        of_class.objects = one.at("objects").whole(0, largest_count);
        of_class.pictures = one.at("pictures").whole(0, tally.pictures);
        of_class.annotations = one.at("annotations").whole(0, largest_count);
        of_class.ignored = one.at("ignored").whole(0, largest_count);
        for (std::size_t k = 0; k < axes.size(); ++k) {
            const CheckedJson counts = one.at(axes[k].key);
            for (const CheckedJson& count : counts.items())
                of_class.histograms[k].push_back(count.whole(0, largest_count));
            if (of_class.histograms[k].size() != axes[k].edges.size() + 1)
                counts.refuse("a count for each interval of 'edges'");
        }
    }
    return tally;
}

}  // namespace

const std::array<StatisticsAxis, statistics_axes>& all_statistics_axes() {
    return axes;
}

Json tally_json(const PictureTally& tally) {
    Json json = {{"pictures", tally.pictures},
                 {"without_objects", tally.without_objects},
                 {"classes", Json::array()}};
    for (const ClassTally& one : tally.classes) {
        Json of_class = {{"name", one.name},
                         {"objects", one.objects},
                         {"pictures", one.pictures},
                         {"annotations", one.annotations},
                         {"ignored", one.ignored}};
        for (std::size_t k = 0; k < axes.size(); ++k)
            of_class[axes[k].key] = one.histograms[k];
        json["classes"].push_back(std::move(of_class));
    }
    return json;
}

void write_statistics(const fs::path& folder, std::span<const std::string> coco_files,
                      bool joined) {
    const bool has_polar =
        std::ranges::find(coco_files, coco_file(CocoPicture::polar)) != coco_files.end();
    PictureCount all;
    Json files = Json::object();
    for (const std::string& file : coco_files) {
        const bool is_whole = file == coco_file(CocoPicture::polar) ||
                              (file == coco_file(CocoPicture::fan) && !has_polar) ||
                              file == coco_file(CocoPicture::record) ||
                              file == coco_file(CocoPicture::scan);
        PictureCount own;
        std::vector<PictureCount*> counts{&own};
        if (is_whole) counts.push_back(&all);
        add_coco(folder / file, joined, counts);
        files[file] = tally_json(tally_of(own));
    }
    Json json = {{"format", "sonarsim statistics"}, {"format_version", 1}};
    for (const StatisticsAxis& axis : axes)
        json["edges"][axis.key] = std::vector<double>(axis.edges.begin(), axis.edges.end());
    json["all"] = tally_json(tally_of(all));
    json["files"] = std::move(files);
    write_file(folder / statistics_name, json_text(json));
}

std::optional<DatasetStatistics> read_statistics(const fs::path& folder) {
    const fs::path path = folder / statistics_name;
    if (!fs::is_regular_file(path)) return std::nullopt;
    const Json json = read_json(path, largest_file);
    const std::string file = path.string();
    const CheckedJson root(json, file);
    if (root.at("format").text() != "sonarsim statistics")
        root.at("format").refuse("\"sonarsim statistics\"");
    root.at("format_version").whole(1, 1);
    DatasetStatistics statistics;
    statistics.all = tally_of(root.at("all"));
    for (const auto& [name, tally] : root.at("files").members())
        statistics.files.emplace_back(name, tally_of(tally));
    return statistics;
}

}  // namespace sonarsim
