#pragma once

#include <memory>

#include "dataset/writer.h"

namespace sonarsim {

/// objects/NNNNNN.json: what the ping shows of each object, in the pixels of the sonar's image
/// (rows of range, columns of beams) and of its fan. With the masks where COCO is asked for, which
/// is made of these files. Null where the mission asks for neither.
std::unique_ptr<Writer> make_objects_writer(const WriterContext& context);

}  // namespace sonarsim
