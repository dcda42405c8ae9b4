#include "gallery/contact_sheet.h"

#include <spdlog/spdlog.h>

#include <memory>

#include "commands.h"
#include "logging.h"

namespace sonarsim {

namespace {

struct SheetArguments {
    std::filesystem::path folder;
    std::filesystem::path out;
    SheetOptions options;
    LogOptions log;
};

int contact_sheet(const SheetArguments& arguments) {
    start_logging(arguments.log);
    const SheetSummary summary =
        write_contact_sheet(arguments.folder, arguments.out, arguments.options);
    spdlog::info("{}: {} pictures", arguments.out.string(), summary.pictures);
    return exit_done;
}

}  // namespace

void add_contact_sheet(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "contact-sheet", "Writes one picture with thumbnails of a dataset's pictures");
    add_examples(command,
                 {"sonarsim contact-sheet out/hull --out hull.png",
                  "sonarsim contact-sheet out/variants --out variants.jpg --sensor fls --ping 2"});
    auto arguments = std::make_shared<SheetArguments>();
    command
        .add_option("folder", arguments->folder,
                    "The folder of a dataset, of the variants of a mission, of a sweep or of a "
                    "collection")
        ->required();
    command.add_option("--out", arguments->out, "The picture to write: .png, .jpg or .webp")
        ->required()
        ->type_name("FILE");
    command.add_option("--sensor", arguments->options.sensor, "Shows this sensor alone")
        ->type_name("NAME");
    command.add_option("--ping", arguments->options.ping, "Shows the N-th ping, counted from 0")
        ->type_name("N");
    command.add_option("--most", arguments->options.most, "Shows at most N pings of a sensor")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = contact_sheet(*arguments); });
}

}  // namespace sonarsim
