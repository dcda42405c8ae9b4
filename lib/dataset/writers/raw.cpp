#include "dataset/writers/formats.h"
#include "dataset/writers/raw_values.h"
#include "format/png.h"

namespace sonarsim {

namespace {

/// raw/NNNNNN.png: 8 or 16 bits [range, azimuth], what the instrument of the calibrated model
/// delivers.
class RawWriter final : public Writer {
  public:
    explicit RawWriter(const WriterContext& context)
        : view_(context.sonar().settings.view),
          model_(*context.sonar().settings.model),
          bytes_(raw_bytes(model_.raw_bits())) {}

    WriterOutputs outputs() const override {
        return {
            PingFile{"raw", ".png"}, png_bytes_at_most(view_.beams, view_.range_bins, bytes_), {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        const std::vector<std::uint16_t> values = model_.raw(ping);
        if (bytes_ == 2) return png_bytes(values, ping.beams, ping.range_bins);
        return png_bytes(as_bytes(values), ping.beams, ping.range_bins);
    }

  private:
    const View& view_;
    const EchoModel& model_;
    int bytes_;
};

}  // namespace

std::unique_ptr<Writer> make_raw_writer(const WriterContext& context) {
    if (!context.mission.output.raw || !context.kind().has_images) return nullptr;
    if (context.sonar().settings.model->raw_bits() == 0) return nullptr;
    return std::make_unique<RawWriter>(context);
}

}  // namespace sonarsim
