#include <algorithm>

#include "core/error.h"
#include "dataset/writers/label_writers.h"
#include "format/id_png.h"
#include "format/png.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_classes = 255;

using Indices = std::vector<std::uint8_t>;

class SemanticWriter final : public Writer {
  public:
    /// `width` and `height` are those of the picture, px.
    SemanticWriter(const WriterContext& context, bool of_fan, int width, int height)
        : of_fan_(of_fan), width_(width), height_(height) {
        for (std::uint32_t id = 0; id <= context.assembly.objects.classes.size(); ++id)
            colours_.push_back(colour_of(id));
    }

    WriterOutputs outputs() const override {
        return {PingFile{.name = of_fan_ ? "fan_semantic" : "semantic",
                         .extension = ".png",
                         .array = of_fan_ ? PingArray::fan : PingArray::bins,
                         .title = of_fan_ ? "classes, fan" : "classes, polar"},
                png_bytes_at_most(width_, height_, 1),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return palette_png_bytes(pixels(finished), width_, height_, colours_);
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        return make_numbers(pixels(finished), height_, width_);
    }

  private:
    Indices pixels(const FinishedPing& finished) const {
        return of_fan_ ? in_fan(*finished.labels) : in_image(finished.labels->bins);
    }

    static Indices in_image(const PingLabels& labels) {
        Indices pixels(labels.size());
        for (int i = 0; i < labels.range_bins; ++i) {
            for (int j = 0; j < labels.beams; ++j) {
                const std::size_t bin = static_cast<std::size_t>(j) * labels.range_bins + i;
                pixels[static_cast<std::size_t>(i) * labels.beams + j] =
                    static_cast<std::uint8_t>(labels.class_id[bin]);
            }
        }
        return pixels;
    }

    static Indices in_fan(const LabelledPing& labels) {
        const std::vector<std::int32_t>& bins = labels.fan_bins->by_row;
        Indices pixels(bins.size(), 0);
        for (std::size_t k = 0; k < bins.size(); ++k) {
            if (bins[k] < 0) continue;
            pixels[k] =
                static_cast<std::uint8_t>(labels.bins.class_id[static_cast<std::size_t>(bins[k])]);
        }
        return pixels;
    }

    bool of_fan_;
    int width_;
    int height_;
    std::vector<Rgb> colours_;
};

}  // namespace

std::vector<std::unique_ptr<Writer>> make_semantic_writers(const WriterContext& context) {
    std::vector<std::unique_ptr<Writer>> writers;
    const Mission& mission = context.mission;
    if (!is_asked(mission, Label::semantic) || !context.kind().has_images) return writers;
    const std::size_t classes = context.assembly.objects.classes.size();
    if (classes > most_classes) {
        throw InputError(mission.output.labels_place.location,
                         "`semantic` has room for 255 classes, and the scene has " +
                             std::to_string(classes) +
                             ": group its nodes with `classes`, or ask for `class` instead");
    }
    const View& view = context.sonar().settings.view;
    writers.push_back(
        std::make_unique<SemanticWriter>(context, false, view.beams, view.range_bins));
    if (mission.output.has_fan()) {
        const FanFrame frame = fan_frame(context.sonar(), mission.output.fan_width_px);
        writers.push_back(
            std::make_unique<SemanticWriter>(context, true, frame.width, frame.height));
    }
    return writers;
}

}  // namespace sonarsim
