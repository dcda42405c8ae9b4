#include "simulate/product/soundings.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "output/dataset/map_place.h"
#include "output/dataset/writer.h"

namespace sonarsim {

namespace {

/// A label of a sounding: the value of the bin where the beam meets the bottom.
struct SoundingLabel {
    const char* name;
    std::vector<std::uint16_t> PingLabels::*bins;
};

std::vector<SoundingLabel> labels_of(const OutputConfig& output) {
    std::vector<SoundingLabel> labels;
    for (const Label label : output.labels) {
        if (label == Label::instance) labels.push_back({"instance", &PingLabels::object});
        if (label == Label::class_name) labels.push_back({"class", &PingLabels::class_id});
    }
    return labels;
}

/// Numbers per sounding in a record before its labels: range, x, y, z and quality.
constexpr std::size_t numbers_of_sounding = 5;

struct RecordedSounding {
    std::size_t pose;
    std::size_t beam;
    double range_m;
    Eigen::Vector3d position;
    double quality;
    std::span<const double> labels;
};

/// Calls `visit` for every sounding, ping by ping and beam by beam; beams without one are left out.
void for_each_sounding(const WriterContext& context, const RecordFile& records,
                       const std::function<void(const RecordedSounding&)>& visit) {
    const Sonar& sonar = context.sonar();
    const std::size_t count = numbers_of_sounding + labels_of(context.mission.output).size();
    std::vector<double> fields(sonar.settings.view.beams * count);
    for (std::size_t k = 0; k < records.records(); ++k) {
        records.read(k, std::as_writable_bytes(std::span(fields)));
        for (std::size_t beam = 0; beam * count < fields.size(); ++beam) {
            const auto f = std::span<const double>(fields).subspan(beam * count, count);
            if (std::isnan(f[0])) continue;
            visit({k * static_cast<std::size_t>(sonar.config.every),
                   beam,
                   f[0],
                   {f[1], f[2], f[3]},
                   f[4],
                   f.subspan(numbers_of_sounding)});
        }
    }
}

/// True if a sounding belongs in a map.
bool good_for_map(const RecordedSounding& sounding) {
    return sounding.quality >= map_quality;
}

std::string csv_line(const RecordedSounding& s, double time_s) {
    return fmt::format("{},{:.6f},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f}{}{}\n", s.pose, time_s,
                       s.beam, s.range_m, s.position.x(), s.position.y(), s.position.z(), s.quality,
                       s.labels.empty() ? "" : ",", fmt::join(s.labels, ","));
}

void write_soundings(const WriterContext& context, const RecordFile& records,
                     const std::filesystem::path& folder) {
    StreamedFile csv(folder / "soundings.csv");
    std::string header = "pose,time_s,beam,range_m,x_m,y_m,z_m,quality";
    std::string properties =
        "property double x\nproperty double y\nproperty double z\n"
        "property float quality\n";
    for (const SoundingLabel& label : labels_of(context.mission.output)) {
        header += std::string(",") + label.name;
        properties += std::string("property uint ") + label.name + "\n";
    }
    csv.append(header + "\n");
    std::uint64_t count = 0;
    for_each_sounding(context, records, [&](const RecordedSounding& s) {
        csv.append(csv_line(s, context.assembly.trajectory[s.pose].t_s));
        ++count;
    });
    csv.finish();

    StreamedFile ply(folder / "soundings.ply");
    ply.append("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
               "\n" + properties + "end_header\n");
    for_each_sounding(context, records, [&](const RecordedSounding& s) {
        ply.append(record_bytes(std::vector{s.position.x(), s.position.y(), s.position.z()}));
        ply.append(record_bytes(std::vector{static_cast<float>(s.quality)}));
        ply.append(record_bytes(std::vector<std::uint32_t>(s.labels.begin(), s.labels.end())));
    });
    ply.finish();
}

void write_bathymetry(const WriterContext& context, const RecordFile& records,
                      const std::filesystem::path& folder) {
    GroundBounds bounds;
    std::uint64_t left_out = 0;
    for_each_sounding(context, records, [&](const RecordedSounding& s) {
        good_for_map(s) ? bounds.add(s.position) : void(++left_out);
    });
    const auto filled = [&](GroundGrid grid) {
        for_each_sounding(context, records, [&](const RecordedSounding& s) {
            if (good_for_map(s)) grid.add(s.position);
        });
        return grid;
    };
    GroundGrid grid = filled(make_ground_grid(bounds, 0.0));
    while (bounds.count > 0) {
        GroundGrid finer = make_ground_grid(bounds, cell_of_soundings(grid, bounds.count));
        if (!(finer.cell_m < grid.cell_m)) break;
        finer = filled(std::move(finer));
        // Soundings of ground that was sounded before fill few cells more.
        if (2 * filled_cells(finer) < 3 * filled_cells(grid)) break;
        grid = std::move(finer);
    }
    write_map(context, folder, "bathymetry", grid, grid.mean(),
              {{"file", "bathymetry.tif"},
               {"values", "mean world z of the soundings in a cell, m; NaN where there are none"}},
              {{"axes",
                "row 0 is north (greatest y), column 0 west (least x): cell (row, column) is "
                "centred at x = west_m + (column + 0.5) cell_m, y = north_m - (row + 0.5) cell_m"},
               {"least_quality", map_quality},
               {"soundings", bounds.count},
               {"soundings_left_out", left_out}});
    const Picture picture = draw_bathymetry(grid);
    write_picture(folder / "bathymetry.png", picture.pixels, picture.width);
}

/// The numbers of the soundings of a ping.
std::vector<double> sounding_fields(const WriterContext& context, const FinishedPing& finished) {
    std::vector<double> all;
    const std::vector<SoundingLabel> labels = labels_of(context.mission.output);
    const std::vector<double>& edges = finished.sonar.range_edges_m;
    std::size_t beam = 0;
    const Pose& T_world_vehicle = context.assembly.trajectory[finished.id.pose].T_world_vehicle;
    for (const Sounding& s :
         find_soundings(finished.sonar, T_world_vehicle, finished.ping, finished.traced.motion)) {
        all.insert(all.end(),
                   {s.range_m, s.position.x(), s.position.y(), s.position.z(), s.quality});
        const auto above = std::ranges::upper_bound(edges, s.range_m) - edges.begin();
        const std::size_t bin =
            beam++ * finished.ping.range_bins + static_cast<std::size_t>(above) - 1;
        for (const SoundingLabel& label : labels)
            all.push_back(std::isnan(s.range_m) ? s.range_m
                                                : (finished.labels->bins.*label.bins)[bin]);
    }
    return all;
}

}  // namespace

/// soundings.npy: float64 [ping, beam, 5 + labels]: range, x, y, z, quality, instance and class if
/// labels; NaN without a sounding. soundings.csv and .ply: the others; bathymetry.*: their map.
Writer make_soundings_writer(const WriterContext& context) {
    const std::size_t beams = context.sonar().settings.view.beams;
    const std::vector<SoundingLabel> labels = labels_of(context.mission.output);
    const auto write_products = [=](const RecordFile& records,
                                    const std::filesystem::path& folder) {
        write_soundings(context, records, folder);
        write_bathymetry(context, records, folder);
    };
    std::string fields = "range_m, x_m, y_m, z_m, quality";
    for (const SoundingLabel& label : labels)
        fields += std::string(", ") + label.name;
    PingRecord record{
        .file = "soundings.npy",
        .format = {"<f8", {context.pings, beams, numbers_of_sounding + labels.size()}},
        .axes = {"ping", "beam", fields}};
    return {.per_ping = std::move(record),
            .products = {"soundings.csv", "soundings.ply", "bathymetry.tif", "bathymetry.json",
                         "bathymetry.png"},
            .encode =
                [=](const FinishedPing& finished) {
                    return record_bytes(sounding_fields(context, finished));
                },
            .write_products = write_products,
            .describe =
                [=](Json& sensor) {
                    const std::string& name = context.sonar().config.name;
                    sensor["pictures"].push_back({{"title", "bathymetry"},
                                                  {"file", name + "/bathymetry.png"},
                                                  {"per", "sensor"}});
                }};
}

}  // namespace sonarsim
