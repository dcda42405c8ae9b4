#pragma once

#include <filesystem>

namespace sonarsim {

/// Bytes of memory that this process can have: the least of what the machine has (MemTotal), of
/// what its control group allows (memory.max, that of the groups around it included) and of what
/// its limits do (RLIMIT_AS). Infinite where nothing of this can be read. `root` is the file system
/// in which /proc and /sys are looked for.
double machine_memory(const std::filesystem::path& root = "/");

/// Bytes that this process holds now; 0 where that cannot be read.
double resident_memory(const std::filesystem::path& root = "/");

}  // namespace sonarsim
