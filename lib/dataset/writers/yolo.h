#pragma once

#include <memory>
#include <vector>

#include "dataset/writer.h"

namespace sonarsim {

/// yolo/NNNNNN.txt and yolo_polygons/NNNNNN.txt, and fan_yolo/ and fan_yolo_polygons/ for the fan:
/// a line per object, with its class from 0 on and its box (middle, width and height) or its
/// outline, in shares of the picture's width and height.
std::vector<std::unique_ptr<Writer>> make_yolo_writers(const WriterContext& context);

}  // namespace sonarsim
