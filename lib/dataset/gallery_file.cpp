#include "dataset/gallery_file.h"

#include <fstream>
#include <string>

namespace sonarsim {

bool has_gallery(const std::filesystem::path& folder) {
    std::error_code absent;
    const std::filesystem::path file = folder / gallery_name;
    if (std::filesystem::symlink_status(file, absent).type() != std::filesystem::file_type::regular)
        return false;
    constexpr std::size_t head_bytes = 1000;
    std::string head(head_bytes, '\0');
    std::ifstream(file, std::ios::binary).read(head.data(), head_bytes);
    return head.find(gallery_mark) != std::string::npos;
}

}  // namespace sonarsim
