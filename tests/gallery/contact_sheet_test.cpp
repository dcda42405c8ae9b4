#include "gallery/contact_sheet.h"

#include <doctest/doctest.h>

#include <atomic>
#include <string>

#include "core/error.h"
#include "job/run_job.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_CASE("a contact sheet that takes too long or too much memory is refused and not written") {
    const TemporaryFolder folder;
    Mission mission = small_mission(folder.path / "out");
    mission.output.fan = FanFormat::png;
    REQUIRE(
        run_job(mission, small_assembly(mission, 2), {.threads = 1}, {}, std::atomic<bool>(false))
            .complete);
    const auto sheet = folder.path / "sheet.png";
    const auto fault = [&](const ChildLimits& limits) {
        SheetOptions options;
        options.limits = limits;
        try {
            write_contact_sheet(folder.path / "out", sheet, options);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto tells = [](const std::string& text, const std::string& part) {
        CAPTURE(text);
        return text.find(part) != std::string::npos;
    };
    constexpr std::size_t roomy = std::size_t{4} << 30;
    // To load OpenImageIO takes 0.2 s and 200 MB of addresses.
    CHECK(tells(
        fault({roomy, 600, 0.01}),
        "sheet.png: not written: OpenImageIO took more than 0.01 s as it drew the contact sheet"));
    CHECK(tells(fault({std::size_t{1} << 20, 600, 300.0}), "sheet.png: not written: "));
    CHECK(!std::filesystem::exists(sheet));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path))
        CHECK(entry.path().filename() == "out");
    CHECK(fault({roomy, 600, 300.0}).empty());
    CHECK(std::filesystem::exists(sheet));
}
