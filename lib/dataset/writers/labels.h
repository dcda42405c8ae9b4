#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// The writers of what `output.labels` asks for: of imaging and profiling sonars a file per ping,
/// NAME/NNNNNN.png or .npy with the rows and columns of the image; of the others a file of records,
/// NAME.npy, shaped as the one of their echoes.
std::vector<std::unique_ptr<Writer>> make_label_writers(const WriterContext& context);

}  // namespace sonarsim
