#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// The writers of all labels that `output.labels` asks for. An imaging or profiling sonar has a
/// file per ping, NAME/NNNNNN.png or .npy with the rows and columns of the image; the others have a
/// file of records, NAME.npy, of the shape of their echoes.
std::vector<std::unique_ptr<Writer>> make_label_writers(const WriterContext& context);

/// objects/NNNNNN.json: each object in the ping with its mask, in the pixels of the sonar's image
/// (rows of range, columns of beams) and of its fan. Null if the mission asks for no objects, and
/// for sonars without images, whose objects are products of their records.
std::unique_ptr<Writer> make_objects_writer(const WriterContext& context);

}  // namespace sonarsim
