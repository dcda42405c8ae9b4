#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "core/error.h"
#include "output/dataset/writer.h"

namespace sonarsim {

// The makers of the formats. They return nothing when the mission does not ask for the format or
// the sonar has no such output.
std::optional<Writer> make_polar_writer(const WriterContext& context);
std::optional<Writer> make_image_writer(const WriterContext& context);
std::optional<Writer> make_raw_writer(const WriterContext& context);
std::optional<Writer> make_fan_writer(const WriterContext& context);
std::optional<Writer> make_stages_writer(const WriterContext& context);
std::optional<Writer> make_strip_writer(const WriterContext& context);
std::optional<Writer> make_soundings_writer(const WriterContext& context);
std::optional<Writer> make_scan_writer(const WriterContext& context);
std::optional<Writer> make_raw_records_writer(const WriterContext& context);
std::optional<Writer> make_meta_writer(const WriterContext& context);

/// The writers of all labels that `output.labels` asks for. An imaging or profiling sonar has a
/// file per ping, NAME/NNNNNN.png or .npy with the rows and columns of the image; the others have a
/// file of records, NAME.npy, of the shape of their echoes.
std::vector<Writer> make_label_writers(const WriterContext& context);

namespace {

using MakeWriter = std::optional<Writer> (*)(const WriterContext&);

/// Every format that a dataset may hold.
constexpr MakeWriter formats[] = {
    make_polar_writer,        //
    make_image_writer,        //
    make_raw_writer,          //
    make_fan_writer,          //
    make_stages_writer,       //
    make_strip_writer,        //
    make_soundings_writer,    //
    make_scan_writer,         //
    make_raw_records_writer,  //
    make_meta_writer,         //
};

/// The writers of some formats and of the labels.
Writers writers_of(std::span<const MakeWriter> makers, const WriterContext& context) {
    Writers writers;
    for (const MakeWriter make : makers) {
        if (auto writer = make(context)) writers.push_back(*std::move(writer));
    }
    std::ranges::move(make_label_writers(context), std::back_inserter(writers));
    return writers;
}

/// InputError when the mission lists the label `fan` and writes no fan. `true` asks only for the
/// labels that there can be.
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

std::vector<std::size_t> count_pings(const Mission& mission, std::size_t poses) {
    std::vector<std::size_t> pings;
    for (const SonarConfig& sensor : mission.sensors) {
        const auto every = static_cast<std::size_t>(sensor.every);
        pings.push_back((poses + every - 1) / every);
    }
    return pings;
}

Writers make_array_writers(const WriterContext& context) {
    constexpr MakeWriter raw_values[] = {make_raw_writer, make_raw_records_writer};
    return writers_of(raw_values, context);
}

Writers make_writers(const WriterContext& context) {
    return writers_of(formats, context);
}

std::vector<Writers> make_writers(const Mission& mission, const Assembly& assembly) {
    check_fan_label(mission);
    const std::vector<std::size_t> pings = count_pings(mission, assembly.trajectory.size());
    std::vector<Writers> all(mission.sensors.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = make_writers({mission, assembly, i, pings[i]});
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
