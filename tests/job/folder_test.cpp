#include "run/job/folder.h"

#include "output/format/png.h"
#include "support/small_mission.h"

namespace fs = std::filesystem;

namespace {

RenderSummary run_poses(const Mission& mission, int poses, bool overwrite) {
    return run_job(mission, small_assembly(mission, poses), {.overwrite = overwrite}, {},
                   std::atomic<bool>(false));
}

/// Ends a refusal that --overwrite overcomes.
constexpr const char* or_overwrite =
    "; choose another output.folder, or replace it with --overwrite";

void check_refused(const Mission& mission, const std::string& what, bool overwrite = false) {
    const auto before = contents(mission.output.folder);
    const std::string message = mission.output.folder.string() + ": " + what;
    CHECK_THROWS_WITH_AS(run_poses(mission, 4, overwrite), message.c_str(), InputError);
    CHECK(contents(mission.output.folder) == before);
}

/// Replaces text in a file.
void edit(const fs::path& path, const std::string& from, const std::string& to) {
    std::string text = read_file(path, 1 << 20);
    REQUIRE(text.find(from) != std::string::npos);
    write_file(path, text.replace(text.find(from), from.size(), to));
}

}  // namespace

TEST_CASE("folder: an empty folder and one with a crash's first breath are fresh") {
    const TemporaryFolder temporary;
    write_file(temporary.path / ".dataset.json.0123456789abcdef.part", "{");
    CHECK(run_poses(small_mission(temporary.path), 2, false).complete);
}

TEST_CASE_FIXTURE(MissionInFolder,
                  "folder: what is not a dataset is never overwritten, asked or not") {
    const std::string cure = "; choose another output.folder";
    for (const bool overwrite : {false, true}) {
        fs::create_directory(out);
        write_file(out / "thesis.tex", "five years");
        check_refused(mission, "holds files that are not a sonarsim dataset" + cure, overwrite);
        for (const char* json :
             {"", "{", "[]", "3", "{}", R"({"format": "other"})", R"({"format": 3})"}) {
            write_file(out / "dataset.json", json);
            check_refused(mission, "holds a dataset.json that is not sonarsim's" + cure, overwrite);
        }
        fs::remove_all(out);
        write_file(out, "a file");
        CHECK_THROWS_WITH_AS(run_poses(mission, 4, overwrite),
                             (out.string() + ": is not a folder").c_str(), InputError);
        fs::remove(out);
    }
}

TEST_CASE_FIXTURE(
    MissionInFolder,
    "folder: versions and builds are mixed where their arithmetic agrees, and only there") {
    run_poses(mission, 4, false);
    const fs::path description = out / "dataset.json";
    edit(description, "\"compiler\": \"", "\"compiler\": \"another ");
    CHECK(run_poses(mission, 4, false).complete);
    const std::string png = png_encoder;
    const std::string start =
        "holds a dataset of this mission made by a build of sonarsim whose bytes differ "
        "(AVX-512, ";
    const std::string end = "; this one: x86-64-v3, " + png + ")" + or_overwrite;
    edit(description, "\"arithmetic\": \"x86-64-v3", "\"arithmetic\": \"AVX-512");
    check_refused(mission, start + png + end);
    edit(description, "\"png_encoder\"", "\"nothing\"");
    check_refused(mission, start + "unknown" + end);
    edit(description, "\"program_version\": \"", "\"program_version\": \"9");
    check_refused(
        mission,
        std::string("holds a dataset of this mission made by another version of sonarsim") +
            or_overwrite);
}

TEST_CASE_FIXTURE(MissionInFolder,
                  "folder: overwrite removes the sensors of the old dataset and nothing else") {
    mission.sensors[1].name = "gone";
    run_poses(mission, 8, false);
    const std::vector<fs::path> notes{out / "notes.txt", out / ".film.mkv.part",
                                      out / "camera/image/000001.png", out / "journal.d/2024.txt"};
    for (const fs::path& note : notes) {
        fs::create_directories(note.parent_path());
        write_file(note, "mine");
    }
    write_file(out / "front/polar/.000007.npy.0123456789abcdef.part", "half");
    write_file(out / "front/mine.txt", "goes with the folder of the sensor");
    mission.sensors[1].name = "left";
    CHECK(run_poses(mission, 3, true).complete);
    const auto files = contents(out);
    CHECK(files.size() == 5 + 4 * 4 + 4);  // front at 0, 1, 2 and left at 0; the notes
    for (const fs::path& note : notes)
        CHECK(read_file(note, 100) == "mine");
    CHECK_FALSE(fs::exists(out / "gone"));
    // Another run of the same dataset leaves them, too.
    fs::remove(out / "front/polar/000000.npy");
    CHECK(run_poses(mission, 3, false).pings == 1);
    CHECK(contents(out) == files);
}

TEST_CASE_FIXTURE(MissionInFolder, "folder: whatever a description says, overwriting stays below") {
    run_poses(mission, 4, false);
    fs::create_directory(temporary.path / "victim");
    write_file(temporary.path / "victim/file", "mine");
    const std::string sound = read_file(out / "dataset.json", 1 << 20);
    for (const std::string& name : std::vector<std::string>{
             "../victim", (temporary.path / "victim").string(), ".", "..", ""}) {
        edit(out / "dataset.json", R"("name": "front")", R"("name": ")" + name + '"');
        edit(out / "dataset.json", "\"pings\": 4", "\"pings\": 1000000000000000000");
        CHECK(run_poses(mission, 4, true).complete);
        CHECK(read_file(out / "dataset.json", 1 << 20) == sound);
        CHECK(read_file(temporary.path / "victim/file", 100) == "mine");
    }
}

TEST_CASE_FIXTURE(MissionInFolder, "folder: neither overwriting nor writing goes through a link") {
    run_poses(mission, 4, false);
    // Another dataset, reached through the first one's folder.
    const Mission other = small_mission(temporary.path / "other");
    run_poses(other, 4, false);
    const auto before = contents(other.output.folder);
    fs::remove_all(out / "left");
    fs::create_directory_symlink(temporary.path / "other/left", out / "left");
    for (const bool overwrite : {false, true}) {
        CHECK_THROWS_AS(run_poses(mission, 4, overwrite), InputError);
        CHECK(contents(other.output.folder) == before);
    }
}

TEST_CASE("folder: a file that the mission reads is never replaced") {
    const TemporaryFolder temporary;
    Mission mission = small_mission(temporary.path);
    write_file(temporary.path / "trajectory.tum", "0 0 0 0 0 0 0 1");
    mission.trajectory = FileTrajectoryConfig{temporary.path / "trajectory.tum", 0.0};
    for (const bool overwrite : {false, true})
        CHECK_THROWS_AS(run_poses(mission, 2, overwrite), InputError);
    CHECK(read_file(temporary.path / "trajectory.tum", 100) == "0 0 0 0 0 0 0 1");
    // A scene in the folder of a sensor of the old dataset, or of the new one.
    const fs::path old = temporary.path / "old";
    mission = small_mission(old);
    mission.sensors[1].name = "gone";
    run_poses(mission, 2, false);
    write_file(old / "gone/scene.glb", "mine");
    const auto before = contents(old);
    mission.sensors[1].name = "left";
    mission.scene.file = old / "gone/scene.glb";
    CHECK_THROWS_AS(run_poses(mission, 2, true), InputError);
    CHECK(contents(old) == before);
    mission = small_mission(temporary.path / "new");
    mission.scene.file = temporary.path / "new/front/scene.glb";
    CHECK_THROWS_AS(run_poses(mission, 2, false), InputError);
    CHECK_FALSE(fs::exists(temporary.path / "new"));
}
