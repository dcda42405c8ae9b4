#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace sonarsim {

/// The source of a glTF buffer's bytes.
struct GltfBuffer {
    enum class Source { data_uri, binary_chunk, file };
    Source source = Source::data_uri;
    std::size_t byte_length = 0;
    std::string file;  ///< relative to the folder of the glTF file
};

/// Finds the source of each buffer of a reduced glTF, and replaces every URI that is no data URI by
/// the buffer's index. InputError with `file` for a URI that leaves the folder of the glTF file,
/// and for a buffer without URI that is not the BIN chunk of a .glb.
std::vector<GltfBuffer> claim_buffers(nlohmann::json& gltf, bool has_binary_chunk,
                                      const std::string& file);

}  // namespace sonarsim
