#include <array>

#include "dataset/writers/formats.h"
#include "format/png.h"
#include "product/fan.h"
#include "product/panels.h"

namespace sonarsim {

namespace {

constexpr int panels = 5;

/// stages/NNNNNN.png: 8 bits, five fans side by side: direct echoes, then with one term of the
/// model after the other.
class StagesWriter final : public Writer {
  public:
    explicit StagesWriter(const WriterContext& context)
        : context_(context),
          map_(make_fan_map(context.sonar(), context.mission.output.fan_width_px)) {}

    WriterOutputs outputs() const override {
        return {PingFile{"stages", ".png"},
                png_bytes_at_most(panels * map_.frame.width, map_.frame.height, 1),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Mission& mission = context_.mission;
        const std::array<Ping, panels> stages =
            form_stages(finished.traced, finished.sonar, context_.assembly.scene,
                        {mission.seed, finished.id.pose});
        return png_bytes(render_panels(map_, stages, context_.full_scale()),
                         panels * map_.frame.width, map_.frame.height);
    }

  private:
    WriterContext context_;
    FanMap map_;
};

}  // namespace

std::unique_ptr<Writer> make_stages_writer(const WriterContext& context) {
    if (!context.mission.output.stages || !context.kind().has_images) return nullptr;
    return std::make_unique<StagesWriter>(context);
}

}  // namespace sonarsim
