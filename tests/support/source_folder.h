#pragma once

#include <filesystem>

namespace sonarsim::test {

/// The folder of the sources under test.
std::filesystem::path source_folder();

}  // namespace sonarsim::test
