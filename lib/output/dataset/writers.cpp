#include <iterator>

#include "core/error.h"
#include "output/dataset/writer.h"
#include "simulate/product/scan.h"

namespace sonarsim {

// The writers of the formats.
Writer make_polar_writer(const WriterContext& context);
Writer make_image_writer(const WriterContext& context);
Writer make_raw_writer(const WriterContext& context);
Writer make_fan_writer(const WriterContext& context);
Writer make_stages_writer(const WriterContext& context);
Writer make_strip_writer(const WriterContext& context);
Writer make_soundings_writer(const WriterContext& context);
Writer make_scan_writer(const WriterContext& context);
Writer make_meta_writer(const WriterContext& context);

/// The writers of `output.labels`: with images a file per ping, NAME/NNNNNN.png or .npy with the
/// rows and columns of the image; else records, NAME.npy, of the shape of the echoes.
std::vector<Writer> make_label_writers(const WriterContext& context);

namespace {

/// True if the mission asks for the output of the sonar's instrument, and its model has one.
bool has_raw(const WriterContext& context) {
    return context.mission.output.raw && context.sonar().settings.model->info.raw_bits > 0;
}

/// InputError for the label `fan` without a fan. `true` asks only for labels that there can be.
void check_fan_label(const Mission& mission) {
    const bool all = mission.output.labels.size() == static_cast<std::size_t>(Label::fan) + 1;
    const bool has_fans =
        mission.output.fan && std::ranges::any_of(mission.sensors, [](const auto& sensor) {
            return kind_of(sensor.kind).has_images;
        });
    if (all || has_fans || !is_listed(mission, Label::fan)) return;
    throw InputError(mission.output.place,
                     "the label 'fan' needs output.fan: true and an imaging or profiling sonar");
}

}  // namespace

Writers make_array_writers(const WriterContext& context) {
    Writers writers = make_label_writers(context);
    if (has_raw(context)) writers.insert(writers.begin(), make_raw_writer(context));
    return writers;
}

Writers make_writers(const WriterContext& context) {
    const OutputConfig& output = context.mission.output;
    const bool images = context.kind().has_images;
    const bool raw = has_raw(context);
    const RecordPictures pictures = context.kind().record.pictures;
    Writers writers;
    const auto add = [&](bool wanted, Writer (*make)(const WriterContext&)) {
        if (wanted) writers.push_back(make(context));
    };
    add(images && output.polar, make_polar_writer);
    add(images && output.image, make_image_writer);
    add(images && raw, make_raw_writer);
    add(images && output.fan, make_fan_writer);
    add(images && output.stages, make_stages_writer);
    add(pictures == RecordPictures::strip, make_strip_writer);
    add(context.sonar().config.kind == SonarKind::profiling, make_soundings_writer);
    add(pictures == RecordPictures::sweeps, make_scan_writer);
    add(!images && raw, make_raw_writer);
    add(true, make_meta_writer);
    std::ranges::move(make_label_writers(context), std::back_inserter(writers));
    return writers;
}

std::vector<Writers> make_writers(const Mission& mission, const Assembly& assembly) {
    check_fan_label(mission);
    std::vector<Writers> all;
    for (std::size_t i = 0; i < mission.sensors.size(); ++i) {
        const std::size_t pings = count_pings(mission.sensors[i], assembly.trajectory.size());
        all.push_back(make_writers({mission, assembly, i, pings}));
    }
    return all;
}

PingRecord record_of_kind(const WriterContext& context, const std::string& stem, const char* type,
                          std::string label, std::string ids) {
    const RecordShape& shape = context.kind().record;
    PingRecord record{.file = stem + ".npy",
                      .format = {type, {context.pings, shape.values(context.sonar().config)}},
                      .axes = {"ping", shape.axis},
                      .label = std::move(label),
                      .ids = std::move(ids)};
    if (!record.label.empty() && shape.bins)
        record.axes[1] = "column, as in " + std::string(shape.name) + ".npy";
    if (shape.upright) {
        std::swap(record.format.shape[0], record.format.shape[1]);
        std::swap(record.axes[0], record.axes[1]);
        record.format.fortran_order = true;
    }
    return record;
}

std::vector<std::string> sweep_files(const WriterContext& context, const std::string& stem,
                                     const std::vector<std::string>& extensions) {
    std::vector<std::string> files;
    for_each_sweep(context.sonar().config, context.pings,
                   [&](std::size_t sweep, std::size_t /*begin*/, std::size_t /*end*/) {
                       for (const std::string& extension : extensions)
                           files.push_back(scan_file_name(stem, sweep, extension));
                   });
    return files;
}

Writer array_writer(PingOutput per_ping, std::function<PingNumbers(const FinishedPing&)> numbers,
                    PngFilter filter) {
    const bool is_record = std::holds_alternative<PingRecord>(per_ping);
    const auto encode = [=](const FinishedPing& ping) {
        const PingNumbers all = numbers(ping);
        if (is_record) return record_bytes(all);
        const auto rows = static_cast<int>(all.shape[0]);
        const auto columns = static_cast<int>(all.shape[1]);
        if (const auto* floats = std::get_if<std::vector<float>>(&all.values))
            return npy_bytes(*floats, rows, columns);
        if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&all.values))
            return png_bytes(*bytes, columns, rows);
        return png_bytes(std::get<std::vector<std::uint16_t>>(all.values), columns, rows, filter);
    };
    return {.per_ping = std::move(per_ping), .encode = encode, .numbers = std::move(numbers)};
}

}  // namespace sonarsim
