#include <filesystem>

namespace sonarsim::test {

std::filesystem::path source_folder() {
    return SONARSIM_SOURCE_DIR;
}

}  // namespace sonarsim::test
