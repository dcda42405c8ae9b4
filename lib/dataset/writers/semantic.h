#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// semantic/NNNNNN.png and fan_semantic/NNNNNN.png: the class of each pixel of the image and of the
/// fan, 8 bits with a colour table. InputError for more classes than 8 bits can name.
std::vector<std::unique_ptr<Writer>> make_semantic_writers(const WriterContext& context);

}  // namespace sonarsim
