#include "target.h"

// Any bytes as a .gltf or .glb.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace sonarsim;
    return check_scene_file(write_input("x.glb", text_of(data, size)));
}
