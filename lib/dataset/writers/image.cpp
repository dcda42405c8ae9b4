#include "dataset/writer.h"
#include "format/png.h"
#include "product/gain.h"

namespace sonarsim {

namespace {

/// image/NNNNNN.png: 16 bits [range, azimuth], 65535 * intensity / full_scale.
class ImageWriter final : public Writer {
  public:
    explicit ImageWriter(const WriterContext& context)
        : view_(context.sonar().settings.view), full_scale_(context.full_scale()) {}

    WriterOutputs outputs() const override {
        return {
            PingFile{
                .name = "image", .extension = ".png", .array = PingArray::bins, .title = "polar"},
            png_bytes_at_most(view_.beams, view_.range_bins, 2),
            {}};
    }

    /// The picture has the rows and columns of polar/. A fan has ahead up and port on the left.
    void describe(nlohmann::ordered_json& sensor) const override {
        sensor["image"] = {{"axes", {"range", "azimuth"}},
                           {"first_row", "nearest range"},
                           {"first_column", "starboard"}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        return png_bytes(grey_16(ping.intensity, full_scale_), ping.beams, ping.range_bins);
    }

  private:
    const View& view_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_image_writer(const WriterContext& context) {
    if (!context.mission.output.image || !context.kind().has_images) return nullptr;
    return std::make_unique<ImageWriter>(context);
}

}  // namespace sonarsim
