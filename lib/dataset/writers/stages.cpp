#include <algorithm>

#include "dataset/writer.h"
#include "format/png.h"
#include "product/fan.h"

namespace sonarsim {

namespace {

/// The fans of several pings of one sonar side by side, the first on the left: grey values
/// [height, pings * width].
std::vector<std::uint8_t> render_panels(const FanMap& map, std::span<const Ping> pings,
                                        double full_scale) {
    const auto width = static_cast<std::size_t>(map.frame.width);
    const auto height = static_cast<std::size_t>(map.frame.height);
    std::vector<std::uint8_t> picture(height * width * pings.size());
    for (std::size_t k = 0; k < pings.size(); ++k) {
        const std::vector<std::uint8_t> fan = render_fan(map, pings[k], full_scale);
        for (std::size_t row = 0; row < height; ++row) {
            std::copy_n(fan.data() + row * width, width,
                        picture.data() + (row * pings.size() + k) * width);
        }
    }
    return picture;
}

/// stages/NNNNNN.png: 8 bits, a fan for each stage of the echo model side by side: direct echoes,
/// then with multipath, then with one random term of the model after the other.
class StagesWriter final : public Writer {
  public:
    explicit StagesWriter(const WriterContext& context)
        : context_(context),
          map_(make_fan_map(context.sonar(), context.mission.output.fan_width_px)),
          width_(static_cast<int>(stage_count(context.sonar())) * map_.frame.width) {}

    WriterOutputs outputs() const override {
        return {PingFile{.name = "stages", .extension = ".png", .title = "stages"},
                png_bytes_at_most(width_, map_.frame.height, 1),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Mission& mission = context_.mission;
        const std::vector<Ping> stages =
            form_stages(finished.traced, finished.sonar, context_.assembly.scene,
                        {mission.seed, finished.id.pose});
        return png_bytes(render_panels(map_, stages, context_.full_scale()), width_,
                         map_.frame.height);
    }

  private:
    WriterContext context_;
    FanMap map_;
    int width_;
};

}  // namespace

std::unique_ptr<Writer> make_stages_writer(const WriterContext& context) {
    if (!context.mission.output.stages || !context.kind().has_images) return nullptr;
    return std::make_unique<StagesWriter>(context);
}

}  // namespace sonarsim
