#include "product/scan.h"

#include "core/atomic_file.h"
#include "dataset/writer.h"
#include "format/npy.h"
#include "format/png.h"
#include "product/fan.h"

namespace sonarsim {

namespace {

/// scan.npy: float32 [ping, range], one column of the display per ping. The display after each
/// sweep of the head, and after the unfinished one at the end: scan_NNNN.npy, float32 [range,
/// step], and scan_NNNN.png, grey, 8 bits, round, boresight up.
class ScanWriter final : public Writer {
  public:
    explicit ScanWriter(const WriterContext& context)
        : context_(context),
          sonar_(context.sonar()),
          name_(context.kind().record.name),
          steps_(scan_steps(sonar_.config)),
          map_(make_fan_map(whole_scan(sonar_), context.mission.output.fan_width_px)) {}

    WriterOutputs outputs() const override {
        WriterOutputs outputs = record_outputs(context_, name_, "<f4", 4);
        const auto values =
            static_cast<double>(sonar_.config.range_bins) * static_cast<double>(steps_);
        for (std::size_t sweep = 0; sweep < scan_sweeps(sonar_.config, context_.pings); ++sweep) {
            outputs.products.push_back({name(sweep, ".npy"), 128.0 + 4.0 * values});
            outputs.products.push_back(
                {name(sweep, ".png"), png_bytes_at_most(map_.frame.width, map_.frame.height, 1)});
        }
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(finished.ping.intensity);
    }

    void write_products(const RecordFile& records,
                        const std::filesystem::path& folder) const override {
        ScanDisplay display(sonar_);
        std::vector<float> bins(sonar_.config.range_bins);
        for (std::size_t ping = 0; ping < context_.pings; ++ping) {
            records.read(ping, std::as_writable_bytes(std::span(bins)));
            display.show(ping, bins);
            const bool last_of_sweep = (ping + 1) % steps_ == 0 || ping + 1 == context_.pings;
            if (last_of_sweep) write_display(display.image(), ping / steps_, folder);
        }
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        const RecordShape& shape = context_.kind().record;
        if (shape.describe) shape.describe(sonar_, sensor);
        const std::string file = sonar_.config.name + "/" + name_ + "_%04d.png";
        const FanFrame& frame = map_.frame;
        sensor["pictures"].push_back({{"title", name_},
                                      {"file", file},
                                      {"per", "sweep"},
                                      {"boxes_of", file},
                                      {"pings", steps_},
                                      {"radius_px", sonar_.config.range_max_m / frame.pixel_m},
                                      {"width_px", frame.width}});
    }

  private:
    std::string name(std::size_t sweep, const char* extension) const {
        return scan_file_name(name_, sweep, extension);
    }

    void write_display(const Ping& image, std::size_t sweep,
                       const std::filesystem::path& folder) const {
        StreamedFile array(folder / name(sweep, ".npy"));
        array.append(npy_bytes(image.intensity, image.range_bins, image.beams));
        array.finish();
        StreamedFile picture(folder / name(sweep, ".png"));
        picture.append(png_bytes(render_fan(map_, image, context_.full_scale()), map_.frame.width,
                                 map_.frame.height));
        picture.finish();
    }

    WriterContext context_;
    const Sonar& sonar_;
    std::string name_;
    std::size_t steps_;
    FanMap map_;
};

}  // namespace

std::unique_ptr<Writer> make_scan_writer(const WriterContext& context) {
    const RecordShape& shape = context.kind().record;
    if (shape.pictures != RecordPictures::sweeps) return nullptr;
    if (!shape.is_written(context.mission.output)) return nullptr;
    return std::make_unique<ScanWriter>(context);
}

}  // namespace sonarsim
