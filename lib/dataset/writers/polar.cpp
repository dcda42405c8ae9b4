#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "dataset/writers/label_writers.h"
#include "format/geotiff.h"
#include "format/picture_encoder.h"

namespace sonarsim {

std::unique_ptr<Writer> make_raw_writer(const WriterContext& context);

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

/// polar/NNNNNN.tif: the same numbers.
class PolarTiffWriter final : public Writer {
  public:
    explicit PolarTiffWriter(const WriterContext& context) : view_(context.sonar().settings.view) {}

    WriterOutputs outputs() const override {
        return {PingFile{"polar", ".tif", PingArray::bins},
                400.0 + 4.0 * view_.range_bins * view_.beams,
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return tiff_bytes(finished.ping.intensity, finished.ping.beams);
    }

  private:
    const View& view_;
};

std::vector<float> as_floats(const std::vector<double>& values) {
    std::vector<float> floats(values.size());
    std::ranges::transform(values, floats.begin(), [](double v) { return static_cast<float>(v); });
    return floats;
}

/// polar/NNNNNN.exr: the intensities as the channel Y. The files of the ping that have the same
/// rows and columns, raw and labels, are layers such as "instance.Y".
///
/// It is not compressed: ZIP takes 52 to 83 ms a ping instead of less than 1, more than most pings
/// take to simulate, and speckle hardly compresses.
class PolarExrWriter final : public Writer {
  public:
    explicit PolarExrWriter(const WriterContext& context)
        : view_(context.sonar().settings.view),
          range_edges_m_(as_floats(context.sonar().range_edges_m)),
          azimuth_edges_rad_(as_floats(context.sonar().azimuth_edges_rad)),
          layers_(make_label_writers(context)) {
        if (auto raw = make_raw_writer(context)) layers_.push_back(std::move(raw));
        std::erase_if(layers_, [](const std::unique_ptr<Writer>& writer) {
            const WriterOutputs outputs = writer->outputs();
            const auto* const file = std::get_if<PingFile>(&outputs.per_ping);
            return file == nullptr || file->array != PingArray::bins;
        });
        names_.reserve(layers_.size());
        for (const auto& layer : layers_)
            names_.push_back(std::get<PingFile>(layer->outputs().per_ping).name + ".Y");
    }

    WriterOutputs outputs() const override {
        const double rows = view_.range_bins;
        const double columns = view_.beams;
        const double channels = 1.0 + static_cast<double>(layers_.size());
        const double header = 2000.0 + 100.0 * channels + 4.0 * (rows + columns);
        return {PingFile{"polar", ".exr", PingArray::bins},
                header + rows * (16.0 + 4.0 * channels * columns),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ping& ping = finished.ping;
        std::vector<PingNumbers> numbers;
        std::vector<SonarsimChannel> channels{{"Y", ping.intensity.data(), sizeof(float), 4}};
        numbers.reserve(layers_.size());
        channels.reserve(1 + layers_.size());
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            numbers.push_back(layers_[k]->numbers(finished).value());
            channels.push_back(std::visit(
                [&](const auto& values) {
                    const std::size_t size = sizeof(values[0]);
                    return SonarsimChannel{names_[k].c_str(), values.data(), size,
                                           static_cast<std::uint32_t>(size)};
                },
                numbers.back().values));
        }
        const std::array attributes{
            SonarsimAttribute{"sonarsim:range_edges_m", range_edges_m_.data(),
                              range_edges_m_.size()},
            SonarsimAttribute{"sonarsim:azimuth_edges_rad", azimuth_edges_rad_.data(),
                              azimuth_edges_rad_.size()}};
        return encoder_.encode(
            {"openexr", "rows: range, the nearest first; columns: azimuth, starboard first",
             static_cast<std::uint32_t>(ping.beams), static_cast<std::uint32_t>(ping.range_bins),
             channels.data(), channels.size(), attributes.data(), attributes.size()});
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        Json layers = Json::object();
        layers["polar"] = "Y";
        for (const std::string& name : names_)
            layers[name.substr(0, name.size() - 2)] = name;
        sensor["exr_channels"] = std::move(layers);
    }

  private:
    using Json = nlohmann::ordered_json;

    PictureEncoder encoder_;
    const View& view_;
    std::vector<float> range_edges_m_;
    std::vector<float> azimuth_edges_rad_;
    std::vector<std::unique_ptr<Writer>> layers_;
    std::vector<std::string> names_;  ///< names of the channels of `layers_`
};

}  // namespace

std::unique_ptr<Writer> make_polar_writer(const WriterContext& context) {
    if (!context.kind().has_images) return nullptr;
    switch (context.mission.output.polar) {
        case PolarFormat::none:
            return nullptr;
        case PolarFormat::npy:
            return std::make_unique<PolarWriter>(context);
        case PolarFormat::exr:
            return std::make_unique<PolarExrWriter>(context);
        case PolarFormat::tiff:
            return std::make_unique<PolarTiffWriter>(context);
    }
    return nullptr;
}

}  // namespace sonarsim
