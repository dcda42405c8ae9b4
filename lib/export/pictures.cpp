#include "export/pictures.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/coco/reader.h"
#include "dataset/file_names.h"
#include "dataset/shared_products.h"
#include "mission/dataset_names.h"
#include "trajectory/interpolate.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t largest_side_px = std::uint64_t{1} << 20;
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 31;  // runs count them in 32 bits

bool has_file(const DescribedSensor& sensor, std::string_view kind) {
    return std::ranges::any_of(sensor.files,
                               [&](const auto& file) { return file.first == kind; }) ||
           (sensor.packs && std::ranges::any_of(sensor.packs->members, [&](const auto& member) {
                return member.first == kind;
            }));
}

/// The picture of all pings ("sensor") or of sweeps ("sweep") that is labelled; null for none.
const Json* picture_per(const Json& sensor, const char* per) {
    if (!sensor.contains("pictures")) return nullptr;
    for (const Json& picture : sensor["pictures"]) {
        if (picture["per"] == per && picture.contains("boxes_of")) return &picture;
    }
    return nullptr;
}

/// The path of a file of a dataset.
fs::path own_file(const fs::path& folder, const std::string& name) {
    if (is_own_file(folder, name)) return folder / name;
    throw InputError({(folder / name).string()},
                     "is missing, or lies behind a link; sonarsim verify says more");
}

/// The part of each pose, by the lists in split/.
std::vector<SplitPart> parts_of_poses(const DatasetFile& file, const fs::path& folder,
                                      std::optional<SplitPart> part) {
    bool has_split = false;
    std::vector<SplitPart> parts(file.poses, part.value_or(SplitPart::none));
    for (std::size_t k = 0; k < split_part_names.size() && !part; ++k) {
        const std::string list = split_file_of(split_part_names[k]);
        if (std::ranges::find(file.products, list) == file.products.end()) continue;
        has_split = true;
        const std::string text = read_file(own_file(folder, list), std::size_t{1} << 30);
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            const auto pose = parse_unsigned(std::string_view(text).substr(begin, end - begin));
            if (!pose || *pose >= parts.size())
                throw InputError({(folder / list).string()}, "must hold numbers of poses");
            parts[*pose] = static_cast<SplitPart>(k);
            begin = end + 1;
        }
    }
    if (!part && !has_split) std::ranges::fill(parts, SplitPart::train);
    return parts;
}

/// The part of all these pings of a sensor; `none` if they are not in one part.
SplitPart part_of_pings(const std::vector<SplitPart>& parts, std::uint64_t every,
                        std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t ping = begin + 1; ping < end; ++ping) {
        if (parts.at(ping * every) != parts.at(begin * every)) return SplitPart::none;
    }
    return parts.at(begin * every);
}

class PictureLister {
  public:
    PictureLister(const DatasetFile& file, std::optional<SplitPart> part, SourceDataset& dataset)
        : file_(file),
          dataset_(dataset),
          place_((dataset.folder / description_name).string()),
          parts_(parts_of_poses(file, dataset.folder, part)) {}

    /// Lists the pictures of one sort of these sensors. InputError without their COCO file.
    void list(CocoPicture sort, const std::vector<std::size_t>& sensors) {
        if (sensors.empty()) return;
        const std::string coco = coco_file(sort);
        if (std::ranges::find(file_.products, coco) == file_.products.end()) {
            throw InputError({dataset_.folder.string()},
                             "has no " + coco +
                                 ", from which objects are exported; set output.labels: [coco] and "
                                 "render it again");
        }
        dataset_.coco_files.push_back(coco);
        std::vector<std::uint64_t> seen(file_.sensors.size(), 0);
        read_coco(own_file(dataset_.folder, coco), "images", [&](const CheckedJson& image) {
            const CheckedJson name = image.at("sensor");
            const auto found =
                std::ranges::find(file_.sensors, name.text(), &DescribedSensor::name);
            if (found == file_.sensors.end()) name.refuse("the name of a sensor");
            const auto index = static_cast<std::size_t>(found - file_.sensors.begin());
            if (std::ranges::find(sensors, index) == sensors.end()) return;
            SourcePicture picture = picture_of_image(image, index);
            if (sort == CocoPicture::record) {
                if (seen[index] > 0) name.refuse("a sensor with one image");
                add_strip_facts(index, picture, name);
            } else if (sort == CocoPicture::scan) {
                add_sweep_facts(index, seen[index], picture, name);
            } else {
                const std::uint64_t pose = image.at("ping").whole(0, file_.poses - 1);
                picture.parts = {parts_[pose]};
            }
            ++seen[index];
            if (!ids_.insert(picture.id).second) image.at("id").refuse("an id of its own");
            dataset_.pictures.push_back(std::move(picture));
        });
    }

  private:
    SourcePicture picture_of_image(const CheckedJson& image, std::size_t index) const {
        const CheckedJson file_name = image.at("file_name");
        const std::string path = file_name.text();
        if (!is_inner_path(path) || !path.starts_with(file_.sensors[index].name + "/"))
            file_name.refuse("the path of a file in the folder of its sensor");
        SourcePicture picture;
        picture.id = image.at("id").whole(1, most_image_id);
        picture.sensor = file_.sensors[index].name;
        picture.full_scale = file_.sensors[index].full_scale;
        picture.width = static_cast<int>(image.at("width").whole(1, largest_side_px));
        picture.height = static_cast<int>(image.at("height").whole(
            1, std::min(largest_side_px, most_pixels / static_cast<std::uint64_t>(picture.width))));
        const std::size_t pack = path.find(".tar/");
        if (pack != path.npos) picture.member = path.substr(pack + 5);
        if (pack != path.npos && std::ranges::count(picture.member, '.') < 2)
            file_name.refuse("the path of a file in a pack, like fls-000000.fan.png");
        picture.file =
            own_file(dataset_.folder, path.substr(0, pack == path.npos ? pack : pack + 4));
        std::string stem = fs::path(path).filename().string();
        stem.resize(std::min(stem.find('.', picture.member.empty() ? 0 : picture.sensor.size()),
                             stem.size()));
        const bool has_sensor = stem.starts_with(picture.sensor + "-");
        picture.name = (dataset_.name.empty() ? "" : dataset_.name + "-") +
                       (has_sensor ? "" : picture.sensor + "-") + stem;
        // Trainers cut the name of a sample at its first point, shells at a blank.
        for (char& c : picture.name) {
            if (!is_plain_name(std::string("x") + c) || c == '.') c = '_';
        }
        return picture;
    }

    void add_strip_facts(std::size_t index, SourcePicture& picture,
                         const CheckedJson& place) const {
        const Json& sensor = file_.json["sensors"][index];
        const Json& described = *picture_per(sensor, "sensor");
        picture.kind = SourcePicture::Kind::strip;
        picture.rows_are_pings = described.value("pings_along", Json("y")) == "y";
        if (sensor["kind"] == "sidescan") picture.nadir = picture.width / 2;
        const auto of_pixel = CheckedJson(described, place_).find("pings_per_pixel");
        const std::uint64_t each = of_pixel ? of_pixel->whole(1, most_poses) : 1;
        const auto rows =
            static_cast<std::uint64_t>(picture.rows_are_pings ? picture.height : picture.width);
        const std::uint64_t pings = file_.sensors[index].pings;
        if ((pings + each - 1) / each != rows)
            place.refuse("one with as many pings as its picture");
        for (std::uint64_t row = 0; row < rows; ++row) {
            picture.parts.push_back(part_of_pings(parts_, file_.sensors[index].every, row * each,
                                                  std::min((row + 1) * each, pings)));
        }
    }

    void add_sweep_facts(std::size_t index, std::uint64_t sweep, SourcePicture& picture,
                         const CheckedJson& place) const {
        const Json& described = *picture_per(file_.json["sensors"][index], "sweep");
        const auto steps = described["pings"].get<std::uint64_t>();
        const std::uint64_t pings = file_.sensors[index].pings;
        if (sweep >= (pings + steps - 1) / steps) place.refuse("one with as many sweeps");
        // The last picture shows pings of the sweep before, too, if it is cut short.
        const std::uint64_t end = std::min((sweep + 1) * steps, pings);
        picture.kind = SourcePicture::Kind::sweep;
        picture.parts = {
            part_of_pings(parts_, file_.sensors[index].every, end - std::min(steps, end), end)};
    }

    const DatasetFile& file_;
    SourceDataset& dataset_;
    std::string place_;             ///< dataset.json, for messages
    std::vector<SplitPart> parts_;  ///< the part of each pose
    std::set<std::uint64_t> ids_;
};

}  // namespace

void add_pictures(const DatasetFile& file, std::optional<SplitPart> part,
                  const ExportOptions& options, SourceDataset& dataset) {
    std::vector<std::size_t> imaging, strips, sweeps;
    for (std::size_t i = 0; i < file.sensors.size(); ++i) {
        const DescribedSensor& sensor = file.sensors[i];
        const bool is_chosen =
            options.sensors.empty() ||
            std::ranges::find(options.sensors, sensor.name) != options.sensors.end();
        if (!is_chosen) continue;
        const Json& described = file.json["sensors"][i];
        if (picture_per(described, "sensor")) {
            strips.push_back(i);
        } else if (picture_per(described, "sweep")) {
            sweeps.push_back(i);
        } else if (sensor.azimuth_bins > 0) {
            imaging.push_back(i);
            const bool has = options.bins ? has_file(sensor, "image") || has_file(sensor, "polar")
                                          : has_file(sensor, "fan");
            if (has) continue;
            throw InputError(
                {dataset.folder.string()},
                options.bins
                    ? "sensor '" + sensor.name +
                          "' has neither images nor arrays of its bins; set output.image: true and "
                          "render it again, or leave out --bins"
                    : "sensor '" + sensor.name +
                          "' has no fans; set output.fan: true and render it again, or take the "
                          "pictures of its bins with --bins");
        }
    }
    PictureLister lister(file, part, dataset);
    lister.list(options.bins ? CocoPicture::polar : CocoPicture::fan, imaging);
    lister.list(CocoPicture::record, strips);
    lister.list(CocoPicture::scan, sweeps);
}

}  // namespace sonarsim
