#include "recording/read_recording.h"

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "recording/read_dataset.h"
#include "recording/recorded_arrays.h"
#include "recording/recording_file.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_recording_yaml = std::size_t{1} << 24;

Recording read_folder_of_arrays(const fs::path& file, const RecordingOptions& options) {
    const std::string source = file.string();
    const std::string text = read_file(file, largest_recording_yaml);
    return read_recorded_arrays(parse_recording(text, source, file.parent_path()),
                                options.most_pings);
}

}  // namespace

Recording load_recording(const fs::path& path, const RecordingOptions& options) {
    Recording recording;
    std::error_code absent;
    if (!fs::is_directory(path, absent)) {
        recording = read_folder_of_arrays(path, options);
    } else if (fs::exists(path / recording_file_name, absent)) {
        recording = read_folder_of_arrays(path / recording_file_name, options);
    } else if (fs::exists(path / "dataset.json", absent)) {
        recording = read_dataset_recording(path, options);
    } else {
        throw InputError({path.string()},
                         "is no recording: it has neither recording.yaml (docs/compare.md) nor "
                         "dataset.json");
    }
    // It stands in JSON, in SVG and in a comment of a preset, which hold UTF-8 without line breaks.
    recording.name = printable(path.lexically_normal().string());
    return recording;
}

}  // namespace sonarsim
