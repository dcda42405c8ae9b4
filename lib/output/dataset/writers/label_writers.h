#pragma once

#include <vector>

#include "output/dataset/writer.h"

namespace sonarsim {

/// The writers of all labels that `output.labels` asks for. An imaging or profiling sonar has a
/// file per ping, NAME/NNNNNN.png or .npy with the rows and columns of the image; the others have a
/// file of records, NAME.npy, of the shape of their echoes.
std::vector<Writer> make_label_writers(const WriterContext& context);

/// objects/NNNNNN.json: each object in the ping with its mask, in the pixels of the sonar's image
/// (rows of range, columns of beams) and of its fan. For sonars with images.
Writer objects_writer(const WriterContext& context);

/// Adds the facts of the objects in the records of a sonar without images to the products of the
/// writer of instance.npy. They are made of that, of object_shadow.npy, visible_share.npy and the
/// echoes: NAME/objects.json for the picture of all pings (waterfall, echogram),
/// NAME/objects_NNNN.json for the picture of each sweep. In the former an object has an entry for
/// each side and each pass; after 32 pings that do not show it, it begins another pass.
void add_record_objects(const WriterContext& context, Writer& writer);

}  // namespace sonarsim
