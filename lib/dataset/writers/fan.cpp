#include "product/fan.h"

#include "dataset/writer.h"
#include "format/png.h"

namespace sonarsim {

namespace {

/// fan/NNNNNN.png: grey, 8 bits, as an operator sees it.
class FanWriter final : public Writer {
  public:
    explicit FanWriter(const WriterContext& context)
        : map_(make_fan_map(context.sonar(), context.mission.output.fan_width_px)),
          view_(context.sonar().settings.view),
          full_scale_(context.full_scale()) {}

    WriterOutputs outputs() const override {
        return {
            PingFile{.name = "fan", .extension = ".png", .array = PingArray::fan, .title = "fan"},
            png_bytes_at_most(map_.frame.width, map_.frame.height, 1),
            {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return png_bytes(render_fan(map_, finished.ping, full_scale_), map_.frame.width,
                         map_.frame.height);
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        const FanFrame& frame = map_.frame;
        sensor["fan"] = {{"width_px", frame.width},
                         {"height_px", frame.height},
                         {"pixel_m", frame.pixel_m},
                         {"apex_px", {0.5 * frame.width, view_.range_max_m / frame.pixel_m}}};
    }

  private:
    FanMap map_;
    const View& view_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_fan_writer(const WriterContext& context) {
    if (!context.kind().has_images || !context.mission.output.fan) return nullptr;
    return std::make_unique<FanWriter>(context);
}

}  // namespace sonarsim
