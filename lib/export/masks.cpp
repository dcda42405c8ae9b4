#include <map>

#include "core/error.h"
#include "core/file.h"
#include "dataset/ping_metadata.h"
#include "export/format.h"
#include "format/id_png.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_classes = 255;  // without the background

/// The layout of MMSegmentation: img_dir/PART/NAME.png, ann_dir/PART/NAME.png with the number of
/// the class of each pixel and a palette, splits/PART.txt with a name a line, and meta.json with
/// the names and colours. Number 0 is the background.
class MasksExport final : public ExportFormat {
  public:
    explicit MasksExport(const ExportContext& context) : context_(context) {
        if (context_.classes.size() > most_classes)
            throw InputError(
                "--format masks: holds at most 255 classes; leave some out (--without)");
        for (std::size_t k = 0; k <= context_.classes.size(); ++k)
            palette_.push_back(colour_of(static_cast<std::uint32_t>(k)));
    }

    void add(const ExportedPicture& picture) override {
        const std::string part = part_text(picture.part);
        place_picture(picture, context_.folder / "img_dir" / part, context_.options.link);
        const std::filesystem::path masks = context_.folder / "ann_dir" / part;
        std::filesystem::create_directories(masks);
        write_file(
            masks / (picture.name + ".png"),
            palette_png_bytes(class_of_pixels(picture), picture.width, picture.height, palette_));
        names_[part] += picture.name + '\n';
    }

    void finish() override {
        std::filesystem::create_directories(context_.folder / "splits");
        for (const auto& [part, names] : names_)
            write_file(context_.folder / "splits" / (part + ".txt"), names);
        nlohmann::ordered_json meta;
        meta["classes"] = {"background"};
        for (const std::string& name : context_.classes)
            meta["classes"].push_back(name);
        for (const Rgb& colour : palette_)
            meta["palette"].push_back({colour.r, colour.g, colour.b});
        write_file(context_.folder / "meta.json", json_text(meta));
    }

  private:
    /// [height, width]
    static std::vector<std::uint8_t> class_of_pixels(const ExportedPicture& picture) {
        const auto width = static_cast<std::size_t>(picture.width);
        const auto height = static_cast<std::size_t>(picture.height);
        std::vector<std::uint8_t> pixels(width * height, 0);
        for (const SourceObject& object : picture.objects) {
            std::size_t at = 0;
            bool inside = false;
            for (const std::uint32_t run : object.mask.runs) {
                for (std::size_t k = at; inside && k < at + run; ++k)
                    pixels[k % height * width + k / height] =
                        static_cast<std::uint8_t>(object.class_number);
                at += run;
                inside = !inside;
            }
        }
        return pixels;
    }

    ExportContext context_;
    std::vector<Rgb> palette_;
    std::map<std::string, std::string> names_;  ///< the names in each part, a line each
};

}  // namespace

std::unique_ptr<ExportFormat> make_masks_export(const ExportContext& context) {
    return std::make_unique<MasksExport>(context);
}

}  // namespace sonarsim
