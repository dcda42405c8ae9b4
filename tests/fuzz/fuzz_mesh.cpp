#include "target.h"

// Any bytes as an .obj, .stl or .ply, as the first of them says.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace sonarsim;
    if (size == 0) return 0;
    const std::string name = data[0] == 'o' ? "x.obj" : data[0] == 's' ? "x.stl" : "x.ply";
    return check_scene_file(write_input(name, text_of(data + 1, size - 1)));
}
