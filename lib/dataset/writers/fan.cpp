#include "dataset/fan_png.h"
#include "dataset/writer.h"

namespace sonarsim {

namespace {

/// fan/NNNNNN.png: 8 bits per channel, as an operator sees it.
class FanWriter final : public Writer {
  public:
    explicit FanWriter(const WriterContext& context)
        : png_(make_fan_png(context.sonar(), context.mission.output)),
          range_max_m_(context.sonar().settings.view.range_max_m),
          full_scale_(context.full_scale()) {}

    WriterOutputs outputs() const override {
        return {
            PingFile{.name = "fan", .extension = ".png", .array = PingArray::fan, .title = "fan"},
            fan_png_bytes_at_most(png_),
            {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return fan_png_bytes(png_, finished.ping, full_scale_);
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        const FanFrame& frame = png_.map.frame;
        sensor["fan"] = {{"width_px", frame.width},
                         {"height_px", frame.height},
                         {"pixel_m", frame.pixel_m},
                         {"apex_px", {0.5 * frame.width, range_max_m_ / frame.pixel_m}}};
    }

  private:
    FanPng png_;
    double range_max_m_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_fan_writer(const WriterContext& context) {
    if (!context.mission.output.fan || !context.kind().has_images) return nullptr;
    return std::make_unique<FanWriter>(context);
}

}  // namespace sonarsim
