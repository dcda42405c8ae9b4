#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dataset/writers/label_writers.h"
#include "format/png.h"
#include "product/scan.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;
using Floats = std::vector<float>;

/// True if the bins [i0, i1) of some beams are all 0, as most of a ping is.
bool is_blank(const std::uint16_t* beams, std::size_t range_bins, std::size_t i0, std::size_t i1,
              std::size_t count) {
    std::uint16_t any = 0;
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t i = i0; i < i1; ++i)
            any |= beams[j * range_bins + i];
    }
    return any == 0;
}

/// Floats count as never blank.
bool is_blank(const float*, std::size_t, std::size_t, std::size_t, std::size_t) {
    return false;
}

/// Transposes [beams, range bins] to [range bins, beams], in tiles that fit into the L1 cache.
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

/// The visible share of the object of each bin; 65535 is all of it, and 0 means that it is not
/// known.
Ids visible_shares(const PingLabels& labels) {
    Ids rounded(labels.object.size());
    std::ranges::transform(labels.object, rounded.begin(), [&](std::uint16_t id) {
        const float share = id == 0 ? std::nanf("") : labels.visible_share[id - 1U];
        if (std::isnan(share)) return std::uint16_t{0};
        return static_cast<std::uint16_t>(std::max(65535.0F * share + 0.5F, 1.0F));
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

/// A file of a label: 16 bits in a PNG, or float32 in .npy. One of the three sources is set.
struct LabelFile {
    Label label;
    const char* name;
    IdsOf ids_of = nullptr;
    FloatsOf floats_of = nullptr;
    const Terms* terms = nullptr;  ///< the terms of an image
    const char* ids = "";          ///< as in PingFile
};

constexpr LabelFile label_files[] = {
    {Label::instance, "instance", ids<&PingLabels::object>, {}, {}, "instances"},
    {Label::share, "share", shares<&PingLabels::share>},
    {Label::second, "second", ids<&PingLabels::second>, {}, {}, "instances"},
    {Label::second, "second_share", shares<&PingLabels::second_share>},
    {Label::class_name, "class", ids<&PingLabels::class_id>, {}, {}, "classes"},
    {Label::material, "material", ids<&PingLabels::material>, {}, {}, "materials"},
    {Label::elevation, "elevation", {}, floats<&PingLabels::elevation_rad>},
    {Label::elevation, "elevation_spread", {}, floats<&PingLabels::elevation_spread_rad>},
    {Label::height, "height", {}, floats<&PingLabels::height_m>},
    {Label::shadow, "shadow", ids<&PingLabels::shadow>, {}, {}, "instances"},
    {Label::multipath, "multipath", shares<&PingLabels::multipath>},
    {Label::clean, "clean", {}, {}, &without_random_terms},
    {Label::direct_only, "direct_only", {}, {}, &direct_echoes_alone},
    {Label::multipath_only, "multipath_only", {}, {}, &multipath_alone},
};

/// Records of sonars without images. Their files of objects are made of these and of the records of
/// instances.
constexpr LabelFile annotation_records[] = {
    {Label::objects, object_shadow_record, ids<&PingLabels::object_shadow>, {}, {}, "instances"},
    {Label::objects, visible_share_record, visible_shares},
};

/// A file per ping with the rows and columns of the sonar's image.
class LabelImageWriter final : public Writer {
  public:
    LabelImageWriter(const WriterContext& context, const LabelFile& file)
        : context_(context), view_(context.sonar().settings.view), file_(file) {}

    WriterOutputs outputs() const override {
        const double bytes = file_.ids_of ? png_bytes_at_most(view_.beams, view_.range_bins, 2)
                                          : 128.0 + 4.0 * view_.range_bins * view_.beams;
        return {PingFile{file_.name, file_.ids_of ? ".png" : ".npy", PingArray::bins, file_.ids},
                bytes,
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        const PingLabels& labels = finished.labels->bins;
        if (file_.terms) {
            return npy_bytes(image(context_, finished, *file_.terms), view_.range_bins,
                             view_.beams);
        }
        if (file_.floats_of)
            return npy_bytes_of_columns(file_.floats_of(labels), view_.range_bins, view_.beams);
        return png_bytes(rows_of_range(file_.ids_of(labels), labels), view_.beams, view_.range_bins,
                         PngFilter::up);
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        const PingLabels& labels = finished.labels->bins;
        const int rows = view_.range_bins;
        const int columns = view_.beams;
        if (file_.terms)
            return make_numbers(image(context_, finished, *file_.terms), rows, columns);
        if (file_.floats_of)
            return make_numbers(rows_of_range(file_.floats_of(labels), labels), rows, columns);
        return make_numbers(rows_of_range(file_.ids_of(labels), labels), rows, columns);
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
        return {PingFile{std::string("fan_") + file_.name, ".png", PingArray::fan, file_.ids},
                png_bytes_at_most(frame_.width, frame_.height, 2),
                {}};
    }

    std::string encode(const FinishedPing& finished) const override {
        return png_bytes(pixels(finished), frame_.width, frame_.height, PngFilter::up);
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        return make_numbers(pixels(finished), frame_.height, frame_.width);
    }

  private:
    Ids pixels(const FinishedPing& finished) const {
        const Ids values = file_.ids_of(finished.labels->bins);
        return fan_values(finished.labels->fan_bins->by_row, values, std::uint16_t{0});
    }

    FanFrame frame_;
    const LabelFile& file_;
};

/// The files of objects in the pictures of the records; dataset/record_objects.h writes them.
std::vector<Product> record_objects(const WriterContext& context) {
    constexpr double longest_object = 1000.0;
    const RecordShape& shape = context.kind().record;
    const SonarConfig& config = context.sonar().config;
    if (!shape.is_written(context.mission.output)) return {};
    const auto objects = static_cast<double>(context.assembly.objects.objects.size());
    // A mask takes at most a byte for a pixel, where ids are as ragged as noise.
    const double bytes = static_cast<double>(shape.values(config) * context.pings) +
                         longest_object * (1.0 + 2.0 * objects);
    if (shape.pictures == RecordPictures::strip) return {{record_objects_name, bytes}};
    std::vector<Product> products;
    for (std::size_t k = 0; k < scan_sweeps(config, context.pings); ++k)
        products.push_back({scan_file_name("objects", k, ".json"), bytes});
    return products;
}

/// A file of records, one to a ping.
class LabelRecordWriter final : public Writer {
  public:
    LabelRecordWriter(const WriterContext& context, const LabelFile& file)
        : context_(context), file_(file) {}

    WriterOutputs outputs() const override {
        WriterOutputs outputs = file_.ids_of
                                    ? record_outputs(context_, file_.name, "<u2", 2, file_.name)
                                    : record_outputs(context_, file_.name, "<f4", 4, file_.name);
        std::get<PingRecord>(outputs.per_ping).ids = file_.ids;
        const bool has_objects =
            file_.label == Label::instance && is_asked(context_.mission, Label::objects);
        if (has_objects) outputs.products = record_objects(context_);
        return outputs;
    }

    std::string encode(const FinishedPing& finished) const override {
        return record_bytes(*numbers(finished));
    }

    std::optional<PingNumbers> numbers(const FinishedPing& finished) const override {
        const PingLabels& labels = finished.labels->bins;
        if (file_.terms) return record(image(context_, finished, *file_.terms), 0.0F);
        if (file_.ids_of)
            return record<std::uint16_t>(rows_of_range(file_.ids_of(labels), labels), 0);
        return record(rows_of_range(file_.floats_of(labels), labels),
                      std::numeric_limits<float>::quiet_NaN());
    }

  private:
    template <class T>
    PingNumbers record(const std::vector<T>& image, T blank) const {
        return make_numbers(
            record_values(context_.kind().record, context_.sonar().config, image, blank));
    }

    WriterContext context_;
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
        const bool for_objects =
            !has_images && file.label == Label::instance && is_asked(mission, Label::objects);
        if (!is_asked(mission, file.label) && !for_objects) continue;
        if (has_images) add(std::make_unique<LabelImageWriter>(context, file));
        if (!has_images) add(std::make_unique<LabelRecordWriter>(context, file));
        if (has_fan && file.ids_of) add(std::make_unique<LabelFanWriter>(context, file));
    }
    for (const LabelFile& file : annotation_records) {
        if (!has_images && is_asked(mission, Label::objects))
            add(std::make_unique<LabelRecordWriter>(context, file));
    }
    add(make_objects_writer(context));
    return writers;
}

}  // namespace sonarsim
