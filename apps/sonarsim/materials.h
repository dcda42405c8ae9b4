#pragma once

#include <filesystem>

namespace sonarsim {

/// Prints how the materials of a CSV scatter in the calibrated model at this frequency in fresh water, by
/// the grazing angle. InputError for a wrong file.
void print_materials(const std::filesystem::path& file, double frequency_khz, bool as_json);

}  // namespace sonarsim
