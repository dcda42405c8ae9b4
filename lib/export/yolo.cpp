#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <set>

#include "core/file.h"
#include "export/format.h"
#include "product/mask_outline.h"

namespace sonarsim {

namespace {

void append_share_of(std::string& line, double pixels, int all) {
    fmt::format_to(std::back_inserter(line), " {:.6f}", pixels / all);
}

/// The layout of Ultralytics: images/PART/NAME.png, labels/PART/NAME.txt, and data.yaml. A line per
/// object: class from 0 on, then middle and size of its box, or the corners of its outline, as
/// shares of the picture. A picture without objects has an empty file.
class YoloExport final : public ExportFormat {
  public:
    explicit YoloExport(const ExportContext& context) : context_(context) {}

    void add(const ExportedPicture& picture) override {
        const std::string part = part_text(picture.part);
        parts_.insert(part);
        place_picture(picture, context_.folder / "images" / part, context_.options.link);
        std::string text;
        for (const SourceObject& object : picture.objects) {
            text += std::to_string(object.class_number - 1);
            context_.options.polygons ? append_outline_of(text, object.mask, picture)
                                      : append_box_of(text, object.box, picture);
            text += '\n';
        }
        const std::filesystem::path labels = context_.folder / "labels" / part;
        std::filesystem::create_directories(labels);
        write_file(labels / (picture.name + ".txt"), text);
    }

    void finish() override {
        // Without 'path' the paths start at the folder of data.yaml. 'train' and 'val' must be
        // there.
        std::string text;
        for (const char* const part : {"train", "val", "test"}) {
            const bool has = parts_.contains(part);
            if (!has && part == std::string("test")) continue;
            const std::string other = parts_.contains("train") ? "train" : *parts_.begin();
            text += std::string(part) + ": images/" + (has ? part : other) +
                    (has ? "\n" : "  # the split has no such part\n");
        }
        text += "names:\n";
        for (std::size_t k = 0; k < context_.classes.size(); ++k) {
            text += "  " + std::to_string(k) + ": " +
                    nlohmann::json(context_.classes[k])
                        .dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) +
                    "\n";
        }
        write_file(context_.folder / "data.yaml", text);
    }

  private:
    static void append_box_of(std::string& text, const PixelBox& box,
                              const ExportedPicture& picture) {
        append_share_of(text, 0.5 * (box.left + box.right), picture.width);
        append_share_of(text, 0.5 * (box.top + box.bottom), picture.height);
        append_share_of(text, box.right - box.left, picture.width);
        append_share_of(text, box.bottom - box.top, picture.height);
    }

    static void append_outline_of(std::string& text, const ObjectMask& mask,
                                  const ExportedPicture& picture) {
        for (const Corner& corner : joined_outline(mask_outlines(mask, picture.height))) {
            append_share_of(text, corner[0], picture.width);
            append_share_of(text, corner[1], picture.height);
        }
    }

    ExportContext context_;
    std::set<std::string> parts_;
};

}  // namespace

std::unique_ptr<ExportFormat> make_yolo_export(const ExportContext& context) {
    return std::make_unique<YoloExport>(context);
}

}  // namespace sonarsim
