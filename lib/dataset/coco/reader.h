#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "dataset/checked_json.h"

namespace sonarsim {

/// Reads a list ("images", "annotations") of a COCO file that CocoFile wrote, item by item, so that
/// the file may be longer than memory. InputError, with the line, when the file cannot be read, is
/// cut off, or does not have one item per line, as CocoFile writes it.
void read_coco(const std::filesystem::path& file, std::string_view list,
               const std::function<void(const CheckedJson& item)>& visit);

}  // namespace sonarsim
