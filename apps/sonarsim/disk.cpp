#include "disk.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "core/error.h"

namespace sonarsim {

namespace {

/// The folder, or the nearest one above it that exists.
std::filesystem::path existing(std::filesystem::path folder) {
    std::error_code unknown;
    while (!std::filesystem::exists(folder, unknown) && folder.has_relative_path())
        folder = folder.parent_path();
    return folder;
}

}  // namespace

void require_writable(const std::filesystem::path& output) {
    const std::filesystem::path folder = existing(output);
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError({folder.string()},
                         "cannot write to this folder: " + std::generic_category().message(errno) +
                             "; choose another output.folder (--out)");
    }
}

std::string size_text(double bytes) {
    constexpr std::array units{"MB", "GB", "TB"};
    double size = 1e-6 * bytes;
    std::size_t unit = 0;
    for (; size >= 1000.0 && unit + 1 < units.size(); ++unit)
        size *= 1e-3;
    return fmt::format("{:.1f} {}", size, units[unit]);
}

}  // namespace sonarsim
