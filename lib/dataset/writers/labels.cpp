#include "dataset/writers/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dataset/png.h"
#include "dataset/writers/object_json.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;
using Floats = std::vector<float>;
using Values = std::variant<Ids, Floats>;

/// One label of one ping, [range bins, beams].
using ValuesOf = Values (*)(const WriterContext& context, const FinishedPing& finished);

/// From [beams, range bins] to [range bins, beams], in tiles that fit the first cache.
template <class T>
std::vector<T> rows_of_range(const std::vector<T>& by_beam, const PingLabels& labels) {
    if (labels.beams == 1) return by_beam;
    constexpr int tile = 16;
    std::vector<T> out(by_beam.size());
    const auto rows = static_cast<std::size_t>(labels.range_bins);
    const auto columns = static_cast<std::size_t>(labels.beams);
    for (std::size_t i0 = 0; i0 < rows; i0 += tile) {
        for (std::size_t j0 = 0; j0 < columns; j0 += tile) {
            for (std::size_t i = i0; i < std::min(i0 + tile, rows); ++i) {
                for (std::size_t j = j0; j < std::min(j0 + tile, columns); ++j)
                    out[i * columns + j] = by_beam[j * rows + i];
            }
        }
    }
    return out;
}

template <Ids PingLabels::*member>
Values ids(const WriterContext&, const FinishedPing& finished) {
    return rows_of_range(finished.labels->*member, *finished.labels);
}

template <Floats PingLabels::*member>
Values floats(const WriterContext&, const FinishedPing& finished) {
    return rows_of_range(finished.labels->*member, *finished.labels);
}

/// Shares as 16 bits: 65535 is all.
template <Floats PingLabels::*member>
Values shares(const WriterContext&, const FinishedPing& finished) {
    const Floats& values = finished.labels->*member;
    Ids rounded(values.size());
    std::ranges::transform(values, rounded.begin(), [](float share) {
        return static_cast<std::uint16_t>(65535.0F * share + 0.5F);
    });
    return rows_of_range(rounded, *finished.labels);
}

template <Terms terms>
Values image(const WriterContext& context, const FinishedPing& finished) {
    return form_image(finished.traced, context.sonar().settings, context.assembly.scene,
                      {context.mission.seed, finished.id.pose}, terms)
        .intensity;
}

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// A file that a label leaves behind.
struct LabelFile {
    Label label;
    const char* name;
    bool is_float;  ///< float32 in .npy, else 16 bits
    float blank;    ///< where a side-scan sonar does not listen
    ValuesOf values;
};

constexpr LabelFile label_files[] = {
    {Label::instance, "instance", false, 0.0F, ids<&PingLabels::object>},
    {Label::share, "share", false, 0.0F, shares<&PingLabels::share>},
    {Label::second, "second", false, 0.0F, ids<&PingLabels::second>},
    {Label::second, "second_share", false, 0.0F, shares<&PingLabels::second_share>},
    {Label::class_name, "class", false, 0.0F, ids<&PingLabels::class_id>},
    {Label::material, "material", false, 0.0F, ids<&PingLabels::material>},
    {Label::elevation, "elevation", true, nothing, floats<&PingLabels::elevation_rad>},
    {Label::elevation, "elevation_spread", true, nothing,
     floats<&PingLabels::elevation_spread_rad>},
    {Label::shadow, "shadow", false, 0.0F, ids<&PingLabels::shadow>},
    {Label::multipath, "multipath", false, 0.0F, shares<&PingLabels::multipath>},
    {Label::clean, "clean", true, 0.0F, image<term_by_term[1]>},
    {Label::direct_only, "direct_only", true, 0.0F, image<direct_echoes_alone>},
    {Label::multipath_only, "multipath_only", true, 0.0F, image<multipath_alone>},
};

/// A ping of a label in the shape of its sonar's records.
template <class T>
std::string label_record(const WriterContext& context, const std::vector<T>& values, T blank) {
    if (context.kind().record != RecordKind::waterfall) return record_bytes(values);
    return record_bytes(sidescan_row<T>(context.sonar().config, values, blank));
}

class LabelWriter final : public Writer {
  public:
    LabelWriter(const WriterContext& context, const LabelFile& file)
        : context_(context), view_(context.sonar().settings.view), file_(file) {}

    WriterOutputs outputs() const override {
        if (!context_.kind().has_images) return record();
        if (file_.is_float) {
            return {PingFile{file_.name, ".npy"}, 128.0 + 4.0 * view_.range_bins * view_.beams, {}};
        }
        return {
            PingFile{file_.name, ".png"}, png_bytes_at_most(view_.beams, view_.range_bins, 2), {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Values values = file_.values(context_, finished);
        if (!context_.kind().has_images) {
            const auto* id_values = std::get_if<Ids>(&values);
            return id_values ? label_record<std::uint16_t>(context_, *id_values, 0)
                             : label_record(context_, std::get<Floats>(values), file_.blank);
        }
        if (const auto* id_values = std::get_if<Ids>(&values))
            return png_bytes(*id_values, view_.beams, view_.range_bins);
        return npy_bytes(std::get<Floats>(values), view_.range_bins, view_.beams);
    }

  private:
    WriterOutputs record() const {
        const SonarConfig& config = context_.sonar().config;
        const char* const type = file_.is_float ? "<f4" : "<u2";
        const auto bins = static_cast<std::size_t>(view_.range_bins);
        const bool rows = context_.kind().record == RecordKind::waterfall;
        const auto columns = rows ? static_cast<std::size_t>(waterfall_columns(config)) : bins;
        const bool upright = context_.kind().record == RecordKind::echogram;
        NpyFormat format{type, {context_.pings, columns}};
        if (upright) format = {type, {columns, context_.pings}, true};
        const double bytes = (file_.is_float ? 4.0 : 2.0) * static_cast<double>(columns);
        nlohmann::ordered_json axes = {"ping", rows ? "column, as in waterfall.npy" : "range"};
        if (upright) axes = {"range", "ping"};
        WriterOutputs outputs = record_outputs(std::string(file_.name) + ".npy", std::move(format),
                                               std::move(axes), bytes);
        std::get<PingRecord>(outputs.per_ping).label = file_.name;
        return outputs;
    }

    WriterContext context_;
    const View& view_;
    const LabelFile& file_;
};

/// objects/NNNNNN.json: what the ping shows of each object.
class ObjectsWriter final : public Writer {
  public:
    explicit ObjectsWriter(const WriterContext& context) : context_(context) {}

    WriterOutputs outputs() const override {
        constexpr double longest_object = 1000.0;
        const double bins = static_cast<double>(context_.sonar().settings.view.range_bins) *
                            context_.sonar().settings.view.beams;
        const auto objects = static_cast<double>(context_.assembly.objects.objects.size());
        return {PingFile{"objects", ".json"}, 100.0 + longest_object * std::min(objects, bins), {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return object_json(context_, finished);
    }

  private:
    WriterContext context_;
};

}  // namespace

std::vector<std::unique_ptr<Writer>> make_label_writers(const WriterContext& context) {
    std::vector<std::unique_ptr<Writer>> writers;
    const std::vector<Label>& asked = context.mission.output.labels;
    const auto is_asked = [&](Label label) {
        return std::ranges::find(asked, label) != asked.end();
    };
    for (const LabelFile& file : label_files) {
        if (is_asked(file.label)) writers.push_back(std::make_unique<LabelWriter>(context, file));
    }
    if (is_asked(Label::objects)) writers.push_back(std::make_unique<ObjectsWriter>(context));
    return writers;
}

}  // namespace sonarsim
