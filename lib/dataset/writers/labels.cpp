#include "dataset/writers/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dataset/writers/objects.h"
#include "dataset/writers/semantic.h"
#include "dataset/writers/yolo.h"
#include "format/id_png.h"
#include "format/png.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;
using Floats = std::vector<float>;

/// Whether the bins [i0, i1) of some beams are all 0. Most of a ping is.
bool is_blank(const std::uint16_t* beams, std::size_t range_bins, std::size_t i0, std::size_t i1,
              std::size_t count) {
    std::uint16_t any = 0;
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = i0; i < i1; ++i)
            any |= beams[j * range_bins + i];
    }
    return any == 0;
}

/// Floats are blank nowhere.
bool is_blank(const float*, std::size_t, std::size_t, std::size_t, std::size_t) {
    return false;
}

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
            const std::size_t i1 = std::min(i0 + tile, rows);
            const std::size_t j1 = std::min(j0 + tile, columns);
            if (is_blank(by_beam.data() + j0 * rows, rows, i0, i1, j1 - j0)) continue;
            for (std::size_t i = i0; i < i1; ++i) {
                for (std::size_t j = j0; j < j1; ++j)
                    out[i * columns + j] = by_beam[j * rows + i];
            }
        }
    }
    return out;
}

/// Labels of 16 bits, [beams, range bins].
using IdsOf = Ids (*)(const PingLabels& labels);

template <Ids PingLabels::*member>
Ids ids(const PingLabels& labels) {
    return labels.*member;
}

/// Shares: 65535 is all.
template <Floats PingLabels::*member>
Ids shares(const PingLabels& labels) {
    const Floats& values = labels.*member;
    Ids rounded(values.size());
    std::ranges::transform(values, rounded.begin(), [](float share) {
        return static_cast<std::uint16_t>(65535.0F * share + 0.5F);
    });
    return rounded;
}

/// Labels that are floats, [beams, range bins].
using FloatsOf = const Floats& (*)(const PingLabels& labels);

template <Floats PingLabels::*member>
const Floats& floats(const PingLabels& labels) {
    return labels.*member;
}

/// The image of some terms of the echo, [range bins, beams].
Floats image(const WriterContext& context, const FinishedPing& finished, const Terms& terms) {
    return form_image(finished.traced, finished.sonar.settings, context.assembly.scene,
                      {context.mission.seed, finished.id.pose}, terms)
        .intensity;
}

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// A file that a label leaves behind: 16 bits in a PNG, or float32 in .npy.
struct LabelFile {
    Label label;
    const char* name;
    IdsOf ids;  ///< these three: what it holds; the others are null
    FloatsOf floats;
    const Terms* image;
    float blank;  ///< where a side-scan sonar does not listen
};

constexpr LabelFile id_file(Label label, const char* name, IdsOf values) {
    return {label, name, values, nullptr, nullptr, 0.0F};
}

constexpr LabelFile float_file(Label label, const char* name, FloatsOf values) {
    return {label, name, nullptr, values, nullptr, nothing};
}

constexpr LabelFile image_file(Label label, const char* name, const Terms& terms) {
    return {label, name, nullptr, nullptr, &terms, 0.0F};
}

constexpr LabelFile label_files[] = {
    id_file(Label::instance, "instance", ids<&PingLabels::object>),
    id_file(Label::share, "share", shares<&PingLabels::share>),
    id_file(Label::second, "second", ids<&PingLabels::second>),
    id_file(Label::second, "second_share", shares<&PingLabels::second_share>),
    id_file(Label::class_name, "class", ids<&PingLabels::class_id>),
    id_file(Label::material, "material", ids<&PingLabels::material>),
    float_file(Label::elevation, "elevation", floats<&PingLabels::elevation_rad>),
    float_file(Label::elevation, "elevation_spread", floats<&PingLabels::elevation_spread_rad>),
    float_file(Label::height, "height", floats<&PingLabels::height_m>),
    id_file(Label::shadow, "shadow", ids<&PingLabels::shadow>),
    id_file(Label::multipath, "multipath", shares<&PingLabels::multipath>),
    image_file(Label::clean, "clean", without_random_terms),
    image_file(Label::direct_only, "direct_only", direct_echoes_alone),
    image_file(Label::multipath_only, "multipath_only", multipath_alone),
};

/// A ping of a label in the shape of its sonar's records.
template <class T>
std::string label_record(const WriterContext& context, const std::vector<T>& values, T blank) {
    if (context.kind().record != RecordKind::waterfall) return record_bytes(values);
    return record_bytes(sidescan_row<T>(context.sonar().config, values, blank));
}

/// A file per ping with the rows and columns of the sonar's image.
class LabelImageWriter final : public Writer {
  public:
    LabelImageWriter(const WriterContext& context, const LabelFile& file)
        : context_(context), view_(context.sonar().settings.view), file_(file) {}

    WriterOutputs outputs() const override {
        if (!file_.ids) {
            return {PingFile{file_.name, ".npy"}, 128.0 + 4.0 * view_.range_bins * view_.beams, {}};
        }
        return {
            PingFile{file_.name, ".png"}, png_bytes_at_most(view_.beams, view_.range_bins, 2), {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const PingLabels& labels = finished.labels->bins;
        if (file_.image) {
            return npy_bytes(image(context_, finished, *file_.image), view_.range_bins,
                             view_.beams);
        }
        if (file_.floats)
            return npy_bytes_of_columns(file_.floats(labels), view_.range_bins, view_.beams);
        return id_png_bytes(rows_of_range(file_.ids(labels), labels), view_.beams,
                            view_.range_bins);
    }

  private:
    WriterContext context_;
    const View& view_;
    const LabelFile& file_;
};

/// fan_LABEL/NNNNNN.png: a label for each pixel of the fan.
class LabelFanWriter final : public Writer {
  public:
    LabelFanWriter(const WriterContext& context, const LabelFile& file)
        : frame_(fan_frame(context.sonar(), context.mission.output.fan_width_px)), file_(file) {}

    WriterOutputs outputs() const override {
        return {PingFile{std::string("fan_") + file_.name, ".png"},
                png_bytes_at_most(frame_.width, frame_.height, 2),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const Ids values = file_.ids(finished.labels->bins);
        return id_png_bytes(fan_values(finished.labels->fan_bins->by_row, values, std::uint16_t{0}),
                            frame_.width, frame_.height);
    }

  private:
    FanFrame frame_;
    const LabelFile& file_;
};

/// A file of records, one to a ping.
class LabelRecordWriter final : public Writer {
  public:
    LabelRecordWriter(const WriterContext& context, const LabelFile& file)
        : context_(context), view_(context.sonar().settings.view), file_(file) {}

    WriterOutputs outputs() const override {
        const SonarConfig& config = context_.sonar().config;
        const char* const type = file_.ids ? "<u2" : "<f4";
        const auto bins = static_cast<std::size_t>(view_.range_bins);
        const bool rows = context_.kind().record == RecordKind::waterfall;
        const auto columns = rows ? static_cast<std::size_t>(waterfall_columns(config)) : bins;
        const bool upright = context_.kind().record == RecordKind::echogram;
        NpyFormat format{type, {context_.pings, columns}};
        if (upright) format = {type, {columns, context_.pings}, true};
        const double bytes = (file_.ids ? 2.0 : 4.0) * static_cast<double>(columns);
        nlohmann::ordered_json axes = {"ping", rows ? "column, as in waterfall.npy" : "range"};
        if (upright) axes = {"range", "ping"};
        WriterOutputs outputs = record_outputs(std::string(file_.name) + ".npy", std::move(format),
                                               std::move(axes), bytes);
        std::get<PingRecord>(outputs.per_ping).label = file_.name;
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        const PingLabels& labels = finished.labels->bins;
        if (file_.image)
            return label_record(context_, image(context_, finished, *file_.image), file_.blank);
        if (file_.floats) {
            return label_record(context_, rows_of_range(file_.floats(labels), labels), file_.blank);
        }
        return label_record<std::uint16_t>(context_, rows_of_range(file_.ids(labels), labels), 0);
    }

  private:
    WriterContext context_;
    const View& view_;
    const LabelFile& file_;
};

}  // namespace

std::vector<std::unique_ptr<Writer>> make_label_writers(const WriterContext& context) {
    std::vector<std::unique_ptr<Writer>> writers;
    const auto add = [&](std::unique_ptr<Writer> writer) {
        if (writer) writers.push_back(std::move(writer));
    };
    const Mission& mission = context.mission;
    const bool has_images = context.kind().has_images;
    const bool has_fan = has_images && mission.output.fan && is_asked(mission, Label::fan);
    for (const LabelFile& file : label_files) {
        // COCO files of waterfalls and echograms are made of the records.
        const bool for_coco =
            !has_images && file.label == Label::instance && is_asked(mission, Label::coco);
        if (!is_asked(mission, file.label) && !for_coco) continue;
        if (has_images) add(std::make_unique<LabelImageWriter>(context, file));
        if (!has_images) add(std::make_unique<LabelRecordWriter>(context, file));
        if (has_fan && file.ids) add(std::make_unique<LabelFanWriter>(context, file));
    }
    add(make_objects_writer(context));
    for (auto& writer : make_semantic_writers(context))
        add(std::move(writer));
    for (auto& writer : make_yolo_writers(context))
        add(std::move(writer));
    return writers;
}

}  // namespace sonarsim
