#include "gallery/unpack.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "core/file.h"
#include "dataset/file_names.h"
#include "format/tar.h"
#include "job/folder.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Makes the folder within that of the page, no part of which may be a link.
void make_folder(const fs::path& page, const fs::path& inner) {
    fs::path folder = page;
    for (const fs::path& part : inner) {
        folder /= part;
        require_no_link(folder, "the page");
        fs::create_directory(folder);
    }
}

/// The pattern of a kind of files in the archives.
std::optional<std::string> member_of(const DescribedPacks& packs, const std::string& kind) {
    const auto found =
        std::ranges::find(packs.members, kind, &std::pair<std::string, std::string>::first);
    if (found == packs.members.end() || !is_picture_name(found->second)) return std::nullopt;
    return found->second;
}

/// Copies the files of a pattern out of one archive.
void unpack(const fs::path& archive, const std::set<std::string>& names, const fs::path& to) {
    if (!fs::is_regular_file(archive)) return;  // not rendered yet
    try {
        for_each_in_tar(archive, [&](const std::string& name, const std::string& bytes) {
            if (names.contains(name)) write_file(to / name, bytes);
        });
    } catch (const std::system_error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw InputError({archive.string()}, std::string(error.what()) + "; run sonarsim verify");
    }
}

/// The pictures of a sensor in its archives.
struct PackedPictures {
    std::string kind;
    std::string pattern;  ///< the names in the archives
};

std::optional<PackedPictures> packed_pictures(const DescribedSensor& sensor) {
    if (!sensor.packs) return std::nullopt;
    for (const std::string kind : {"fan", "image"}) {
        if (const auto pattern = member_of(*sensor.packs, kind))
            return PackedPictures{kind, *pattern};
    }
    return std::nullopt;
}

/// The folder of the unpacked pictures, relative to that of the page.
fs::path unpacked_folder(const std::string& member, const DescribedSensor& sensor,
                         const PackedPictures& pictures) {
    return fs::path(gallery_folder_name) / member / sensor.name / pictures.kind;
}

}  // namespace

std::map<std::string, Json> pictures_in_packs(const std::string& member,
                                              const DatasetFile& dataset) {
    std::map<std::string, Json> pictures;
    for (const DescribedSensor& sensor : dataset.sensors) {
        const auto own = packed_pictures(sensor);
        if (!own) continue;
        const fs::path file = unpacked_folder(member, sensor, *own) / own->pattern;
        const bool is_fan = own->kind == "fan";
        Json picture = {{"title", own->kind},
                        {"file", file.generic_string()},
                        {"per", "ping"},
                        {"unpacked", true},
                        {"boxes_of", is_fan ? "fan" : "bins"}};
        if (!is_fan) picture["ahead"] = "down";
        pictures[sensor.name] = Json::array({std::move(picture)});
    }
    return pictures;
}

void unpack_pictures(const fs::path& page, const std::string& member, const DatasetFile& dataset) {
    for (const DescribedSensor& sensor : dataset.sensors) {
        const auto own = packed_pictures(sensor);
        if (!own) continue;
        const fs::path inner = unpacked_folder(member, sensor, *own);
        make_folder(page, inner);
        const DescribedPacks& packs = *sensor.packs;
        for (std::uint64_t first = 0; first < sensor.pings; first += packs.pings) {
            const std::uint64_t end = std::min(first + packs.pings, sensor.pings);
            std::set<std::string> names;
            for (std::uint64_t ping = first; ping < end; ++ping)
                names.insert(numbered(own->pattern, ping * sensor.every));
            unpack(page / member / numbered(packs.file, first / packs.pings), names, page / inner);
        }
    }
}

}  // namespace sonarsim
