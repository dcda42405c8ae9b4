#include <array>

#include "core/error.h"
#include "dataset/fan_png.h"
#include "dataset/writer.h"
#include "format/picture_encoder.h"

namespace sonarsim {

namespace {

void describe_fan(const FanFrame& frame, const View& view, nlohmann::ordered_json& sensor) {
    sensor["fan"] = {{"width_px", frame.width},
                     {"height_px", frame.height},
                     {"pixel_m", frame.pixel_m},
                     {"apex_px", {0.5 * frame.width, view.range_max_m / frame.pixel_m}}};
}

/// fan/NNNNNN.png: 8 bits per channel, as an operator sees it.
class FanWriter final : public Writer {
  public:
    explicit FanWriter(const WriterContext& context)
        : png_(make_fan_png(context.sonar(), context.mission.output)),
          view_(context.sonar().settings.view),
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
        describe_fan(png_.map.frame, view_, sensor);
    }

  private:
    FanPng png_;
    const View& view_;
    double full_scale_;
};

/// fan/NNNNNN.jpg or .webp: the same picture, a little changed to take less space.
class LossyFanWriter final : public Writer {
  public:
    explicit LossyFanWriter(const WriterContext& context)
        : png_(make_fan_png(context.sonar(), context.mission.output)),
          is_webp_(context.mission.output.fan == FanFormat::webp),
          view_(context.sonar().settings.view),
          full_scale_(context.full_scale()) {
        constexpr int longest_webp_side = 16383;
        if (is_webp_ && png_.map.frame.height > longest_webp_side) {
            throw InputError("output.fan: webp has at most 16383 rows, and the fan of sensor '" +
                             context.sonar().config.name + "' would have " +
                             std::to_string(png_.map.frame.height) +
                             "; give a lower output.fan_width_px");
        }
    }

    WriterOutputs outputs() const override {
        // Noise in three channels of the best quality takes less.
        constexpr double most_bytes_per_pixel = 6.0;
        const FanFrame& frame = png_.map.frame;
        return {PingFile{.name = "fan",
                         .extension = is_webp_ ? ".webp" : ".jpg",
                         .array = PingArray::fan,
                         .title = "fan"},
                2000.0 + most_bytes_per_pixel * frame.width * frame.height,
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const std::vector<std::uint8_t> grey = render_fan(png_.map, finished.ping, full_scale_);
        if (!png_.style) return encode_pixels(grey.data(), 1, is_webp_ ? 3 : 1);
        const Picture picture = styled_fan(*png_.style, grey);
        return encode_pixels(reinterpret_cast<const std::uint8_t*>(picture.pixels.data()), 3, 3);
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        describe_fan(png_.map.frame, view_, sensor);
    }

  private:
    /// `own`: channels of the pixels; `written`: those of the file, since WebP has no grey.
    std::string encode_pixels(const std::uint8_t* pixels, std::size_t own,
                              std::size_t written) const {
        const std::array<const char*, 3> names{"R", "G", "B"};
        std::array<SonarsimChannel, 3> channels{};
        for (std::size_t k = 0; k < written; ++k)
            channels[k] = {written == 1 ? "Y" : names[k], pixels + (own == 1 ? 0 : k), own, 1};
        const FanFrame& frame = png_.map.frame;
        return encoder_.encode(
            {is_webp_ ? "webp" : "jpeg", "", static_cast<std::uint32_t>(frame.width),
             static_cast<std::uint32_t>(frame.height), channels.data(), written, nullptr, 0});
    }

    PictureEncoder encoder_;
    FanPng png_;
    bool is_webp_;
    const View& view_;
    double full_scale_;
};

}  // namespace

std::unique_ptr<Writer> make_fan_writer(const WriterContext& context) {
    const FanFormat format = context.mission.output.fan;
    if (format == FanFormat::none || !context.kind().has_images) return nullptr;
    if (format == FanFormat::png) return std::make_unique<FanWriter>(context);
    return std::make_unique<LossyFanWriter>(context);
}

}  // namespace sonarsim
