#include <spdlog/fmt/fmt.h>

#include <map>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/ping_metadata.h"
#include "export/format.h"
#include "export/objects_json.h"
#include "format/coco_counts.h"
#include "format/tar.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t shard_bytes = std::size_t{256} << 20;
constexpr std::size_t longest_member = 100;  ///< the limit of the format ustar

/// Shards of WebDataset: PART-000000.tar with NAME.png and NAME.json for each picture, and
/// classes.txt. The JSON has lists with an entry per object, and the masks in COCO's compressed
/// runs.
class WebDatasetExport final : public ExportFormat {
  public:
    explicit WebDatasetExport(const ExportContext& context) : context_(context) {}

    void add(const ExportedPicture& picture) override {
        if (picture.name.size() + 5 > longest_member) {
            throw InputError("--format webdataset: '" + picture.name +
                             "' is too long for the name of a file in a tar archive; give the "
                             "mission and its sensors shorter names");
        }
        const std::string part = part_text(picture.part);
        Shard& shard = shards_[part];
        const std::string json = json_of(picture).dump() + '\n';
        const std::size_t bytes = tar_bytes(picture.png.size()) + tar_bytes(json.size());
        if (!shard.archive.empty() && shard.archive.size() + bytes + tar_end_bytes > shard_bytes)
            write(part, shard);
        append_to_tar(shard.archive, picture.name + ".png", picture.png);
        append_to_tar(shard.archive, picture.name + ".json", json);
    }

    void finish() override {
        for (auto& [part, shard] : shards_)
            write(part, shard);
        std::string names;
        for (const std::string& name : context_.classes)
            names += printable(name) + '\n';
        write_file(context_.folder / "classes.txt", names);
    }

  private:
    struct Shard {
        std::string archive;
        int number = 0;
    };

    static Json json_of(const ExportedPicture& picture) {
        Json objects = objects_json(picture);
        objects["mask"] = Json::array();
        for (const SourceObject& object : picture.objects)
            objects["mask"].push_back(coco_counts(object.mask.runs));
        return {{"width", picture.width}, {"height", picture.height}, {"objects", objects}};
    }

    void write(const std::string& part, Shard& shard) const {
        shard.archive.append(tar_end_bytes, '\0');
        write_file(context_.folder / fmt::format("{}-{:06}.tar", part, shard.number++),
                   shard.archive);
        shard.archive.clear();
    }

    ExportContext context_;
    std::map<std::string, Shard> shards_;
};

}  // namespace

std::unique_ptr<ExportFormat> make_webdataset_export(const ExportContext& context) {
    return std::make_unique<WebDatasetExport>(context);
}

}  // namespace sonarsim
