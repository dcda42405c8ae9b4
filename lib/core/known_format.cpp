#include "core/known_format.h"

#include <array>
#include <utility>

namespace sonarsim {

std::string_view known_format(std::string_view bytes) {
    using namespace std::literals;
    constexpr std::array<std::pair<std::string_view, std::string_view>, 9> formats{
        {{"glTF", "a .glb mesh"},
         {"{", "JSON, such as a .gltf mesh"},
         {"II*\0"sv, "a TIFF picture, such as a GeoTIFF"},
         {"MM\0*"sv, "a TIFF picture, such as a GeoTIFF"},
         {"\x89PNG", "a PNG picture"},
         {"\x93NUMPY", "a NumPy array"},
         {"BLENDER", "a Blender file"},
         {"PK\x03\x04", "a ZIP archive, such as a spreadsheet"},
         {"version https://git-lfs", "a pointer of Git LFS, whose file `git lfs pull` fetches"}}};
    for (const auto& [begin, format] : formats) {
        if (bytes.starts_with(begin)) return format;
    }
    return {};
}

}  // namespace sonarsim
