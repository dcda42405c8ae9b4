#include "product/scan.h"

#include "core/atomic_file.h"
#include "dataset/fan_png.h"
#include "dataset/writers/formats.h"
#include "format/npy.h"

namespace sonarsim {

namespace {

/// scan.npy: float32 [ping, range], one column of the display per ping. Of each sweep of the head,
/// and of the unfinished one at the end, the display as it stood then: scan_NNNN.npy, float32
/// [range, step], and scan_NNNN.png, 8 bits per channel, round,
/// boresight up.
class ScanWriter final : public Writer {
  public:
    explicit ScanWriter(const WriterContext& context)
        : sonar_(context.sonar()),
          pings_(context.pings),
          full_scale_(context.full_scale()),
          steps_(scan_steps(sonar_.config)),
          png_(make_fan_png(whole_scan(sonar_), context.mission.output)) {}

    WriterOutputs outputs() const override {
        const auto bins = static_cast<std::size_t>(sonar_.config.range_bins);
        WriterOutputs outputs = record_outputs("scan.npy", {"<f4", {pings_, bins}},
                                               {"ping", "range"}, 4.0 * static_cast<double>(bins));
        for (std::size_t sweep = 0; sweep < scan_sweeps(sonar_.config, pings_); ++sweep) {
            outputs.products.push_back(
                {name(sweep, ".npy"), 128.0 + 4.0 * static_cast<double>(bins * steps_)});
            outputs.products.push_back({name(sweep, ".png"), fan_png_bytes_at_most(png_)});
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
        for (std::size_t ping = 0; ping < pings_; ++ping) {
            records.read(ping, std::as_writable_bytes(std::span(bins)));
            display.show(ping, bins);
            const bool last_of_sweep = (ping + 1) % steps_ == 0 || ping + 1 == pings_;
            if (last_of_sweep) write_display(display.image(), ping / steps_, folder);
        }
    }

    void describe(nlohmann::ordered_json& sensor) const override {
        sensor["scan"] = {{"pings_per_sweep", steps_},
                          {"step_edges_rad", scan_edges_rad(sonar_.config)},
                          {"axes", {"range", "step"}}};
    }

  private:
    static std::string name(std::size_t sweep, const char* extension) {
        return scan_file_name("scan", sweep, extension);
    }

    void write_display(const Ping& image, std::size_t sweep,
                       const std::filesystem::path& folder) const {
        StreamedFile array(folder / name(sweep, ".npy"));
        array.append(npy_bytes(image.intensity, image.range_bins, image.beams));
        array.finish();
        StreamedFile picture(folder / name(sweep, ".png"));
        picture.append(fan_png_bytes(png_, image, full_scale_));
        picture.finish();
    }

    const Sonar& sonar_;
    std::size_t pings_;
    double full_scale_;
    std::size_t steps_;
    FanPng png_;
};

}  // namespace

std::unique_ptr<Writer> make_scan_writer(const WriterContext& context) {
    const bool records = context.kind().record == RecordKind::scan;
    if (!context.mission.output.scan || !records) return nullptr;
    return std::make_unique<ScanWriter>(context);
}

}  // namespace sonarsim
