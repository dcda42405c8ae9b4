#pragma once

#include <string>

#include "dataset/coco/statistics.h"

namespace sonarsim {

/// The labels of a dataset for people: pictures, objects of each class, histograms.
std::string statistics_text(const PictureTally& tally);

}  // namespace sonarsim
