#include "gallery/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <vector>

#include "core/atomic_file.h"
#include "core/child_process.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/module.h"
#include "core/text.h"
#include "dataset/dataset_file.h"
#include "dataset/file_names.h"
#include "format/text_font.h"
#include "gallery/members.h"
#include "gallery/sheet_module.h"
#include "mission/dataset_names.h"
#include "scene/images/module.h"
#include "scene/images/read_image.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using SheetJson = nlohmann::ordered_json;

constexpr std::size_t most_on_sheet = 1024;
constexpr std::size_t many_on_sheet = 36;  // beyond which they are smaller
constexpr std::size_t most_letters = 44;   // in a line of a caption

struct SheetPicture {
    fs::path file;
    std::string caption;
    bool turned = false;
};

/// The name that OpenImageIO has for the format of a file's extension.
std::string sheet_format(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".png") return "png";
    if (extension == ".jpg" || extension == ".jpeg") return "jpeg";
    if (extension == ".webp") return "webp";
    throw InputError({file.string()}, "a contact sheet is a .png, a .jpg or a .webp");
}

/// The datasets of a sweep's points, within the folder of the sweep. A point of a mission with
/// variants is shown by the first of them.
std::vector<std::string> sweep_folders(const fs::path& sweep) {
    const fs::path index = sweep / "index.csv";
    const CsvTable table = read_csv(index, std::size_t{64} << 20);
    const auto& names = table.header.fields;
    const auto column = std::ranges::find(names, "folder");
    if (column == names.end()) throw InputError({index.string()}, "has no column 'folder'");
    std::vector<std::string> folders;
    for (const CsvRow& row : table.rows) {
        const std::string& folder = row.fields[static_cast<std::size_t>(column - names.begin())];
        if (folder.empty() || folder.front() == '.' || folder.find('/') != std::string::npos) {
            throw InputError({index.string(), row.line},
                             "'" + printable(folder) + "' is no folder of a sweep");
        }
        const std::string first = page_members(sweep / folder).members.front().folder;
        folders.push_back(first.empty() ? folder : folder + "/" + first);
    }
    return folders;
}

/// The datasets in a folder; "" is the folder itself.
std::vector<std::string> sheet_members(const fs::path& folder) {
    if (fs::is_regular_file(folder / "index.csv") && !fs::exists(folder / description_name))
        return sweep_folders(folder);
    std::vector<std::string> folders;
    for (const PageMember& member : page_members(folder).members)
        folders.push_back(member.folder);
    return folders;
}

/// `count` of the numbers 0 to `all` - 1, spread evenly; the middle one if `count` is 1.
std::vector<std::uint64_t> spread_numbers(std::uint64_t all, std::uint64_t count) {
    std::vector<std::uint64_t> numbers;
    if (all == 0) return numbers;
    count = std::min(count, all);
    numbers.reserve(count);
    for (std::uint64_t k = 0; k < count; ++k)
        numbers.push_back(count == 1 ? all / 2 : k * (all - 1) / (count - 1));
    return numbers;
}

/// Adds the pictures of a sensor that exist: at most `count` pings or sweeps.
void add_pictures(const fs::path& folder, const SheetJson& sensor, std::uint64_t count,
                  const std::optional<std::uint64_t>& ping, std::vector<SheetPicture>& out) {
    if (!sensor.contains("pictures") || sensor["pictures"].empty()) return;
    const SheetJson& picture = sensor["pictures"].front();
    const auto name = sensor.at("name").get<std::string>();
    const auto file = picture.at("file").get<std::string>();
    const auto per = picture.at("per").get<std::string>();
    const auto add = [&](const std::string& path, const std::string& caption) {
        std::error_code ignored;
        if (!is_inner_path(path) || !fs::is_regular_file(folder / path, ignored)) return;
        out.push_back({folder / path, caption, picture.value("ahead", "") == "down"});
    };
    if (per == "sensor") return add(file, name);
    const std::uint64_t pings = sensor.at("pings").get<std::uint64_t>();
    const bool is_sweep = per == "sweep";
    const std::uint64_t each =
        is_sweep ? std::max<std::uint64_t>(picture.at("pings").get<std::uint64_t>(), 1) : 1;
    const std::uint64_t every = is_sweep ? 1 : sensor.value("every", std::uint64_t{1});
    const std::uint64_t all = pings / each + (pings % each > 0 ? 1 : 0);
    std::vector<std::uint64_t> numbers = spread_numbers(all, count);
    if (ping) numbers.assign(*ping / each < all ? 1 : 0, *ping / each);
    for (const std::uint64_t number : numbers) {
        add(numbered(file, number * every),
            name + (is_sweep ? "  sweep " : "  ping ") + std::to_string(number));
    }
}

/// The pictures of a dataset. `one`: a single one, of the first sensor that has any.
std::vector<SheetPicture> pictures_of(const fs::path& folder, const SheetOptions& options,
                                      bool one) {
    const DatasetFile dataset = require_dataset(folder);
    std::vector<SheetPicture> pictures;
    try {
        for (const SheetJson& sensor : dataset.json.at("sensors")) {
            if (!options.sensor.empty() && sensor.at("name") != options.sensor) continue;
            add_pictures(folder, sensor, one ? 1 : options.most, options.ping, pictures);
            if (one && !pictures.empty()) break;
        }
    } catch (const nlohmann::json::exception&) {
        throw InputError({(folder / description_name).string()},
                         "lists pictures otherwise than sonarsim does; run sonarsim verify");
    }
    return pictures;
}

/// The text in lines that fit under a thumbnail: "seed=3,range=5" is cut at the comma. OpenImageIO
/// 2.4 draws other signs for those beyond ASCII.
std::string caption_lines(const std::string& text) {
    std::string lines;
    std::size_t length = 0;
    for (const char c : printable(text)) {
        lines += static_cast<unsigned char>(c) < 0x80 ? c : '?';
        if (c == ',' || ++length == most_letters) {
            lines += '\n';
            length = 0;
        }
    }
    return lines;
}

std::vector<SheetPicture> all_pictures(const fs::path& folder, const SheetOptions& options) {
    const std::vector<std::string> members = sheet_members(folder);
    if (members.size() == 1 && members.front().empty()) return pictures_of(folder, options, false);
    std::vector<SheetPicture> pictures;
    for (const std::string& member : members) {
        for (SheetPicture& picture : pictures_of(folder / member, options, true)) {
            picture.caption = caption_lines(member) + "\n" + picture.caption;
            pictures.push_back(std::move(picture));
        }
    }
    return pictures;
}

/// Runs in the child process, which sends the reason of a failure to the parent.
void draw_in_child(const ChildOutput& write, const SonarsimSheet& sheet) {
    std::array<char, 1000> error{};
    std::string reason;
    try {
        const auto draw = reinterpret_cast<SonarsimWriteSheet>(
            module_symbol(image_module, sheet_module_symbol, image_package));
        if (draw(&sheet, error.data(), error.size()) != 0)
            reason = std::string(error.data()) + " (OpenImageIO says so)";
    } catch (const InputError& fault) {
        reason = fault.what();
    }
    write(reason.data(), reason.size());
}

void draw_sheet_file(std::span<const SheetPicture> pictures, const fs::path& file,
                     const std::string& format, const ChildLimits& limits) {
    std::vector<std::string> files;
    std::vector<SonarsimThumbnail> thumbnails;
    files.reserve(pictures.size());
    thumbnails.reserve(pictures.size());
    for (const SheetPicture& picture : pictures) {
        files.push_back(picture.file.string());
        thumbnails.push_back(
            {files.back().c_str(), picture.caption.c_str(), picture.turned ? 1U : 0U});
    }
    const std::size_t count = pictures.size();
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    AtomicFile written(file);
    const std::string part = written.part().string();
    const SonarsimSheet sheet{
        thumbnails.data(), count,          columns,     count > many_on_sheet ? 200U : 320U,
        text_font(file),   format.c_str(), part.c_str()};
    std::string reason;
    try {
        reason =
            bytes_of_child([&](const ChildOutput& write) { draw_in_child(write, sheet); }, limits);
    } catch (const InputError& error) {
        reason = std::string("OpenImageIO ") + error.what() + " as it drew the contact sheet";
    }
    std::ranges::replace(reason, '\n', ' ');
    if (!reason.empty()) throw InputError({file.string()}, "not written: " + printable(reason));
    written.commit();
}

}  // namespace

SheetSummary write_contact_sheet(const fs::path& folder, const fs::path& file,
                                 const SheetOptions& options) {
    const std::string format = sheet_format(file);
    const std::vector<SheetPicture> pictures = all_pictures(folder, options);
    if (pictures.empty()) {
        const std::string whose = options.sensor.empty() ? "" : " of '" + options.sensor + "'";
        throw InputError({folder.string()},
                         "has no pictures" + whose +
                             "; output.fan or output.image writes them, and tar archives "
                             "(output.pack) have to be unpacked");
    }
    if (pictures.size() > most_on_sheet) {
        throw InputError({folder.string()}, "has " + std::to_string(pictures.size()) +
                                                " pictures to show, and a sheet has at most " +
                                                std::to_string(most_on_sheet) +
                                                "; give a lower --most, or a --sensor");
    }
    draw_sheet_file(pictures, file, format, options.limits);
    return {pictures.size()};
}

}  // namespace sonarsim
