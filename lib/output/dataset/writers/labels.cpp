#include <cmath>
#include <type_traits>

#include "output/dataset/writer.h"
#include "simulate/product/fan.h"

namespace sonarsim {

/// objects/NNNNNN.json: each object in the ping with its mask, in the pixels of the sonar's image
/// (rows of range, columns of beams) and of its fan. For sonars with images.
Writer objects_writer(const WriterContext& context);

/// Adds the facts of the objects in the records of a sonar without images to the products of the
/// writer of instance.npy: objects.json for the picture of all pings (waterfall, echogram), or
/// objects_NNNN.json for that of each sweep. In the former an object has an entry for each side and
/// each pass; after 32 pings that do not show it, it begins another pass.
void add_record_objects(const WriterContext& context, Writer& writer);

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
            if constexpr (std::is_integral_v<T>) {
                if (is_blank(by_beam.data() + j0 * rows, rows, i0, i1, j1 - j0)) continue;
            }
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
        return static_cast<std::uint16_t>(65535.0F * share + 0.49F);  // two sum to 65535 at most
    });
    return rounded;
}

/// The visible share of the object of each bin; 65535 is all of it, 0 that it is not known.
Ids visible_shares(const PingLabels& labels) {
    Ids rounded(labels.facts().size());
    std::ranges::transform(labels.facts(), rounded.begin(), [&](std::uint16_t id) {
        const float share = id == 0 ? std::nanf("") : labels.visible_share[id - 1U];
        if (std::isnan(share)) return std::uint16_t{0};
        return static_cast<std::uint16_t>(std::max(65535.0F * share + 0.5F, 1.0F));
    });
    return rounded;
}

/// A file of a label: 16 bits in a PNG, or float32 in .npy. One of the three sources is set.
struct LabelFile {
    Label label;
    const char* name;
    IdsOf ids_of = nullptr;
    Floats PingLabels::*floats = nullptr;
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
    {Label::elevation, "elevation", {}, &PingLabels::elevation_rad},
    {Label::elevation, "elevation_spread", {}, &PingLabels::elevation_spread_rad},
    {Label::height, "height", {}, &PingLabels::height_m},
    {Label::shadow, "shadow", ids<&PingLabels::shadow>, {}, {}, "instances"},
    {Label::multipath, "multipath", shares<&PingLabels::multipath>},
    {Label::clean, "clean", {}, {}, &without_random_terms},
    {Label::direct_only, "direct_only", {}, {}, &direct_echoes_alone},
    {Label::multipath_only, "multipath_only", {}, {}, &multipath_alone},
};

/// Records of which, with those of instances or outlines, files of objects are made.
constexpr LabelFile annotation_records[] = {
    {Label::objects, object_shadow_record, ids<&PingLabels::object_shadow>, {}, {}, "instances"},
    {Label::objects, visible_share_record, visible_shares},
    {Label::objects, silhouette_record, ids<&PingLabels::silhouette>, {}, {}, "instances"},
};

PingNumbers label_numbers(const WriterContext& context, const LabelFile& file,
                          const FinishedPing& finished) {
    const PingLabels& labels = finished.labels->bins;
    const Sonar& sonar = context.sonar();
    if (file.terms) {
        const PingKey key{context.mission.seed, finished.id.pose};
        Ping image = form_image(finished.traced, finished.sonar.settings, context.assembly.scene,
                                key, *file.terms);
        return numbers_of(sonar, std::move(image.intensity), 0.0F);
    }
    if (file.ids_of)
        return numbers_of<std::uint16_t>(sonar, rows_of_range(file.ids_of(labels), labels), 0);
    return numbers_of(sonar, rows_of_range(labels.*file.floats, labels), std::nanf(""));
}

/// NAME/NNNNNN.png or .npy with the rows and columns of the image, or a record in NAME.npy.
Writer label_writer(const WriterContext& context, const LabelFile& file) {
    PingOutput output;
    if (context.kind().has_images)
        output = PingFile{file.name, file.ids_of ? ".png" : ".npy", PingArray::bins, file.ids};
    else
        output =
            record_of_kind(context, file.name, file.ids_of ? "<u2" : "<f4", file.name, file.ids);
    return array_writer(
        std::move(output),
        [context, &file](const FinishedPing& ping) { return label_numbers(context, file, ping); },
        PngFilter::up);
}

/// fan_NAME/NNNNNN.png: a label for each pixel of the fan.
Writer fan_label_writer(const WriterContext& context, const LabelFile& file) {
    const FanFrame frame = fan_frame(context.sonar());
    const auto pixels = [&file, frame](const FinishedPing& finished) -> PingNumbers {
        return {fan_values(finished.labels->fan_bins->by_row, file.ids_of(finished.labels->bins),
                           std::uint16_t{0}),
                {static_cast<std::size_t>(frame.height), static_cast<std::size_t>(frame.width)}};
    };
    return array_writer(PingFile{std::string("fan_") + file.name, ".png", PingArray::fan, file.ids},
                        pixels, PngFilter::up);
}

}  // namespace

std::vector<Writer> make_label_writers(const WriterContext& context) {
    std::vector<Writer> writers;
    const Mission& mission = context.mission;
    const bool has_images = context.kind().has_images;
    const bool has_fan = has_images && mission.output.fan && is_listed(mission, Label::fan);
    const bool record_objects = !has_images && is_listed(mission, Label::objects);
    for (const LabelFile& file : label_files) {
        const bool for_objects = record_objects && file.label == Label::instance;
        if (!is_listed(mission, file.label) && !for_objects) continue;
        writers.push_back(label_writer(context, file));
        if (for_objects) add_record_objects(context, writers.back());
        if (has_fan && file.ids_of) writers.push_back(fan_label_writer(context, file));
    }
    for (const LabelFile& file : annotation_records) {
        const bool wanted = mission.labels.mask != MaskKind::echo || file.name != silhouette_record;
        if (record_objects && wanted) writers.push_back(label_writer(context, file));
    }
    if (has_images && is_listed(mission, Label::objects))
        writers.push_back(objects_writer(context));
    return writers;
}

}  // namespace sonarsim
