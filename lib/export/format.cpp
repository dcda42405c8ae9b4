#include "export/format.h"

#include "core/error.h"
#include "core/file.h"

namespace sonarsim {

namespace fs = std::filesystem;

std::string part_text(SplitPart part) {
    return std::string(split_part_names.at(static_cast<std::size_t>(part)));
}

void place_picture(const ExportedPicture& picture, const fs::path& folder, bool link) {
    fs::create_directories(folder);
    const fs::path file = folder / (picture.name + ".png");
    if (!link || picture.original.empty()) {
        write_file(file, picture.png);
        return;
    }
    std::error_code refused;
    fs::create_hard_link(picture.original, file, refused);
    if (!refused) return;
    throw InputError({picture.original.string()}, "cannot be linked to " + file.string() + " (" +
                                                      refused.message() +
                                                      "); leave out --link, or export to the disk "
                                                      "that holds the dataset");
}

}  // namespace sonarsim
