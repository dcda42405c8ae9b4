#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// The writers of all labels that `output.labels` asks for. An imaging or profiling sonar has a
/// file per ping, NAME/NNNNNN.png or .npy with the rows and columns of the image; the others have a
/// file of records, NAME.npy, of the shape of their echoes.
std::vector<std::unique_ptr<Writer>> make_label_writers(const WriterContext& context);

/// objects/NNNNNN.json: each object in the ping, in the pixels of the sonar's image (rows of range,
/// columns of beams) and of its fan. If COCO is asked for, the files have masks, from which the
/// COCO files are made. Null if the mission asks for neither objects nor COCO.
std::unique_ptr<Writer> make_objects_writer(const WriterContext& context);

/// semantic/NNNNNN.png and fan_semantic/NNNNNN.png: the class of each pixel of the image and of the
/// fan, 8 bits with a colour table. InputError for more classes than 8 bits can name.
std::vector<std::unique_ptr<Writer>> make_semantic_writers(const WriterContext& context);

/// yolo/NNNNNN.txt and yolo_polygons/NNNNNN.txt, and fan_yolo/ and fan_yolo_polygons/ for the fan:
/// a line per object, with its class from 0 on and its box (middle, width and height) or its
/// outline, as shares of the picture's width and height.
std::vector<std::unique_ptr<Writer>> make_yolo_writers(const WriterContext& context);

}  // namespace sonarsim
