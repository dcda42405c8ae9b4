#include <map>

#include "dataset/coco/file.h"
#include "export/format.h"
#include "product/mask_outline.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The layout of the COCO dataset: PART/NAME.png and annotations/instances_PART.json, whose paths
/// are relative to PART/. Ids are unique over all parts.
class CocoExport final : public ExportFormat {
  public:
    explicit CocoExport(const ExportContext& context) : context_(context) {}

    void add(const ExportedPicture& picture) override {
        const std::string part = part_text(picture.part);
        place_picture(picture, context_.folder / part, context_.options.link);
        Lists& lists = lists_[part];
        const std::uint64_t image_id = ++images_;
        lists.images.push_back({{"id", image_id},
                                {"file_name", picture.name + ".png"},
                                {"width", picture.width},
                                {"height", picture.height}});
        for (const SourceObject& object : picture.objects) {
            CocoAnnotation annotation =
                mask_annotation(object.mask, static_cast<std::uint64_t>(picture.width),
                                static_cast<std::uint64_t>(picture.height));
            annotation.id = ++annotations_;
            annotation.image_id = image_id;
            annotation.instance = object.mask.id;
            annotation.category = object.class_number;
            annotation.is_crowd = object.is_crowd;
            annotation.seen = object.seen;
            annotation.left = object.box.left;
            annotation.top = object.box.top;
            annotation.width = object.box.right - object.box.left;
            annotation.height = object.box.bottom - object.box.top;
            Json json = annotation_json(annotation);
            if (context_.options.polygons) json["segmentation"] = polygons_of(object.mask, picture);
            lists.annotations.push_back(std::move(json));
        }
    }

    void finish() override {
        Json description = {{"mission", context_.datasets.at(0).at("mission")},
                            {"program_version", context_.datasets.at(0).at("program_version")}};
        for (std::size_t k = 0; k < context_.classes.size(); ++k)
            description["labels"]["classes"].push_back(
                {{"id", k + 1}, {"name", context_.classes[k]}});
        const std::filesystem::path folder = context_.folder / "annotations";
        std::filesystem::create_directories(folder);
        for (const auto& [part, lists] : lists_) {
            CocoFile file(folder / ("instances_" + part + ".json"), description);
            for (const bool is_images : {true, false}) {
                file.begin_list(is_images ? "images" : "annotations");
                for (const Json& item : is_images ? lists.images : lists.annotations)
                    file.add(item);
                file.end_list();
            }
            file.finish();
        }
    }

  private:
    struct Lists {
        std::vector<Json> images;
        std::vector<Json> annotations;
    };

    /// [[x, y, x, y, ...], ...]: the outline of each part.
    static Json polygons_of(const ObjectMask& mask, const ExportedPicture& picture) {
        Json polygons = Json::array();
        for (const std::vector<Corner>& outline : mask_outlines(mask, picture.height)) {
            Json polygon = Json::array();
            for (const Corner& corner : outline) {
                polygon.push_back(corner[0]);
                polygon.push_back(corner[1]);
            }
            polygons.push_back(std::move(polygon));
        }
        return polygons;
    }

    ExportContext context_;
    std::map<std::string, Lists> lists_;
    std::uint64_t images_ = 0;
    std::uint64_t annotations_ = 0;
};

}  // namespace

std::unique_ptr<ExportFormat> make_coco_export(const ExportContext& context) {
    return std::make_unique<CocoExport>(context);
}

}  // namespace sonarsim
