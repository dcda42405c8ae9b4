#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "dataset/writers/label_writers.h"
#include "product/mask_outline.h"

namespace sonarsim {

namespace {

/// Appends `pixels` / `all`, such as " 0.123456".
void append_share(std::string& line, double pixels, int all) {
    fmt::format_to(std::back_inserter(line), " {:.6f}", pixels / all);
}

/// The picture of a ping that is labelled.
struct LabelledPicture {
    bool is_fan;
    int width;
    int height;
};

class YoloWriter final : public Writer {
  public:
    YoloWriter(const WriterContext& context, bool polygons, const LabelledPicture& picture)
        : objects_(context.assembly.objects),
          rules_(context.mission.labels),
          polygons_(polygons),
          picture_(picture) {}

    WriterOutputs outputs() const override {
        const std::string name = polygons_ ? "yolo_polygons" : "yolo";
        const double pixels = static_cast<double>(picture_.width) * picture_.height;
        const double lines = std::min(static_cast<double>(objects_.objects.size()), pixels);
        // An outline has at most two corners per pixel; outlines of real objects have far fewer.
        const double bytes = 50.0 * lines + (polygons_ ? pixels : 0.0);
        return {PingFile{picture_.is_fan ? "fan_" + name : name, ".txt"}, bytes, {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        std::string text;
        for (const ObjectMask& mask :
             picture_.is_fan ? finished.labels->fan : finished.labels->polar) {
            const ObjectInPing& seen =
                *std::ranges::lower_bound(finished.labels->seen, mask.id, {}, &ObjectInPing::id);
            const std::optional<PixelBox> box = box_of(seen, mask);
            if (!box) continue;
            text += std::to_string(objects_.class_of(mask.id - 1));
            polygons_ ? append_outline(text, mask) : append_box(text, *box);
            text += '\n';
        }
        return text;
    }

  private:
    /// Nothing for an object that is not annotated.
    std::optional<PixelBox> box_of(const ObjectInPing& seen, const ObjectMask& mask) const {
        if (is_annotated(facts_of(seen, objects_, mask.area), rules_) != Annotated::yes)
            return std::nullopt;
        const BinBox& bins = seen.shadow;
        const PixelBox shadow = picture_.is_fan ? seen.shadow_in_fan
                                                : PixelBox{bins.first_line, bins.last_line + 1,
                                                           bins.first_bin, bins.last_bin + 1};
        return annotation_box({mask.left, mask.right, mask.top, mask.bottom},
                              shadow.is_empty() ? std::nullopt : std::optional(shadow), rules_.box);
    }

    void append_box(std::string& text, const PixelBox& box) const {
        append_share(text, 0.5 * (box.left + box.right), picture_.width);
        append_share(text, 0.5 * (box.top + box.bottom), picture_.height);
        append_share(text, box.right - box.left, picture_.width);
        append_share(text, box.bottom - box.top, picture_.height);
    }

    void append_outline(std::string& text, const ObjectMask& mask) const {
        for (const Corner& corner : joined_outline(mask_outlines(mask, picture_.height))) {
            append_share(text, corner[0], picture_.width);
            append_share(text, corner[1], picture_.height);
        }
    }

    const SceneObjects& objects_;
    const LabelConfig& rules_;
    bool polygons_;
    LabelledPicture picture_;
};

}  // namespace

std::vector<std::unique_ptr<Writer>> make_yolo_writers(const WriterContext& context) {
    std::vector<std::unique_ptr<Writer>> writers;
    if (!context.kind().has_images) return writers;
    const View& view = context.sonar().settings.view;
    std::vector<LabelledPicture> pictures{{false, view.beams, view.range_bins}};
    if (context.mission.output.has_fan()) {
        const FanFrame frame = fan_frame(context.sonar(), context.mission.output.fan_width_px);
        pictures.push_back({true, frame.width, frame.height});
    }
    for (const Label label : {Label::yolo, Label::yolo_polygons}) {
        if (!is_asked(context.mission, label)) continue;
        for (const LabelledPicture& picture : pictures) {
            writers.push_back(
                std::make_unique<YoloWriter>(context, label == Label::yolo_polygons, picture));
        }
    }
    return writers;
}

}  // namespace sonarsim
