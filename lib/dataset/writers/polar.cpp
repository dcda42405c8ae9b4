#include "dataset/writer.h"

namespace sonarsim {

namespace {

/// polar/NNNNNN.npy: float32 [range, azimuth], the intensities as simulated.
class PolarWriter final : public Writer {
  public:
    explicit PolarWriter(const WriterContext& context) : view_(context.sonar().settings.view) {}

    WriterOutputs outputs() const override {
        return {PingFile{"polar", ".npy", PingArray::bins},
                128.0 + 4.0 * view_.range_bins * view_.beams,
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        return npy_bytes(ping.intensity, ping.range_bins, ping.beams);
    }

  private:
    const View& view_;
};

}  // namespace

std::unique_ptr<Writer> make_polar_writer(const WriterContext& context) {
    if (!context.kind().has_images || !context.mission.output.polar) return nullptr;
    return std::make_unique<PolarWriter>(context);
}

}  // namespace sonarsim
