#include "gallery/gallery.h"

#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "commands.h"
#include "logging.h"

namespace sonarsim {

namespace {

struct GalleryArguments {
    std::filesystem::path folder;
    LogOptions log;
};

int gallery(const GalleryArguments& arguments) {
    start_logging(arguments.log);
    const GallerySummary summary = write_gallery(arguments.folder);
    const std::string datasets =
        summary.datasets > 1 ? std::to_string(summary.datasets) + " datasets, " : "";
    spdlog::info("{}: {}{} pings, {:.1f} MB; open it in a browser", summary.file.string(), datasets,
                 summary.pings, 1e-6 * static_cast<double>(summary.bytes));
    return exit_done;
}

}  // namespace

void add_gallery(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "gallery", "Writes a page to look through a dataset, index.html in its folder");
    add_examples(command, {"sonarsim gallery out/hull"});
    auto arguments = std::make_shared<GalleryArguments>();
    command
        .add_option("folder", arguments->folder,
                    "The folder of a dataset, of the variants of a mission, or of a collection")
        ->required();
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = gallery(*arguments); });
}

}  // namespace sonarsim
