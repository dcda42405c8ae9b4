#pragma once

#include <string>

#include "dataset/writer.h"

namespace sonarsim {

/// The objects that a ping shows, as the text of a JSON file. Its pixels are those of the sonar's
/// image: rows of range, columns of beams.
std::string object_json(const WriterContext& context, const FinishedPing& finished);

}  // namespace sonarsim
