#include "export/export.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.h"
#include "core/error.h"
#include "core/text.h"
#include "logging.h"
#include "progress.h"
#include "signals.h"

namespace sonarsim {

namespace {

struct ExportArguments {
    std::filesystem::path folder;
    std::filesystem::path dest;
    std::string format;
    ExportOptions options;
    LogOptions log;
};

ExportKind kind_named(const std::string& name) {
    const std::vector<std::string> names{"yolo", "coco", "masks", "imagefolder", "webdataset"};
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<ExportKind>(found - names.begin());
    throw InputError("--format: there is no '" + printable(name) + "'" + did_you_mean(name, names) +
                     "; there are: yolo, coco, masks, imagefolder, webdataset");
}

void require_sound(const ExportOptions& options) {
    if (options.overlap_px > 0 && options.overlap_px >= options.tile_px)
        throw InputError("--overlap: must be less than --tile");
}

/// "96 train, 12 val".
template <class Counts>
std::string counts_text(const Counts& counts) {
    std::string text;
    for (const auto& [name, count] : counts)
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    return text;
}

void tell(const ExportArguments& arguments, const ExportSummary& summary) {
    if (arguments.log.json) {
        fmt::print("{}", json_line({{"pictures", summary.pictures},
                                    {"objects", summary.objects},
                                    {"without_objects", summary.without_objects},
                                    {"left_out_pictures", summary.left_out.pictures},
                                    {"left_out_pieces", summary.left_out.pieces},
                                    {"was_there", summary.was_there},
                                    {"complete", summary.complete}}));
    }
    const std::string dest = arguments.dest.string();
    if (summary.was_there) {
        spdlog::info("{}: holds this export already", dest);
        return;
    }
    if (summary.left_out.pictures > 0) {
        spdlog::warn("left out {} pictures whose pings are not in one part of the split",
                     summary.left_out.pictures);
    }
    if (summary.left_out.pieces > 0) {
        spdlog::info("left out {} objects or pieces below --least-share or --least-pixels",
                     summary.left_out.pieces);
    }
    const bool one_part = summary.pictures.size() == 1;
    if (one_part)
        spdlog::warn("all pictures are in one part; output.split or variants keep some for tests");
    spdlog::info("{}: pictures: {}; objects: {}; {} pictures without objects", dest,
                 counts_text(summary.pictures), counts_text(summary.objects),
                 summary.without_objects);
}

int export_all(ExportArguments& arguments) {
    start_logging(arguments.log);
    arguments.options.kind = kind_named(arguments.format);
    require_sound(arguments.options);
    const std::atomic<bool>& stop = stop_on_signal(
        warning_line(arguments.log, "stopped at once; the same command run again begins anew"));
    ExportSummary summary;
    {
        ProgressLine line(arguments.log, "pictures");
        summary = export_dataset(arguments.folder, arguments.dest, arguments.options,
                                 line.callback(), stop);
    }
    if (!summary.complete) {
        spdlog::warn("stopped; nothing is left of the export");
        return exit_signal + signal_received();
    }
    tell(arguments, summary);
    return exit_done;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "export", "Writes the pictures and labels of a dataset in the layout of a trainer");
    add_examples(command, {"sonarsim export out/hull yolo_hull --format yolo",
                           "sonarsim export out/survey tiles --format yolo --sensor sss --tile 640 "
                           "--overlap 64"});
    auto arguments = std::make_shared<ExportArguments>();
    ExportOptions& options = arguments->options;
    command
        .add_option("folder", arguments->folder,
                    "The folder of a dataset, of variants or of a collection")
        ->required();
    command.add_option("dest", arguments->dest, "The folder to write")->required();
    command
        .add_option("--format", arguments->format,
                    "The layout: yolo, coco, masks, imagefolder or webdataset")
        ->required()
        ->type_name("FORMAT");
    command.add_option("--sensor", options.sensors, "Only this sensor; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--without", options.without, "A class that is no object; may be repeated")
        ->allow_extra_args(false);
    command.add_flag("--bins", options.bins,
                     "Of imaging and profiling sonars the picture of the bins, not the fan");
    command.add_flag("--link", options.link, "Hard links to pictures that need no change");
    command.add_flag("--polygons", options.polygons, "Outlines instead of boxes or runs");
    command
        .add_option("--tile", options.tile_px, "Side of the tiles of waterfalls, echograms, scans")
        ->check(CLI::Range(16, 1 << 16))
        ->type_name("PIXELS");
    command.add_option("--overlap", options.overlap_px, "Pixels that neighbouring tiles share")
        ->check(CLI::Range(0, 1 << 16))
        ->type_name("PIXELS");
    command
        .add_option("--least-pixels", options.least_pixels,
                    "Objects with fewer pixels in a picture are left out; default: "
                    "labels.min_pixels of the dataset")
        ->check(CLI::Range(1, 1 << 30));
    command
        .add_option("--least-share", options.least_share,
                    "Pieces of an object in a tile below this share of its pixels are left out")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command
        .add_option("--licence", options.licence, "Licence of the data, for an image folder's card")
        ->capture_default_str();
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = export_all(*arguments); });
}

}  // namespace sonarsim
