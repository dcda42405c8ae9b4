#pragma once

#include <filesystem>

namespace sonarsim {

/// Bytes of memory that this process can have: the least of the machine's memory (MemTotal), the
/// limits of its control group and of the groups around it (memory.max) and its own limit
/// (RLIMIT_AS). Infinite if none can be read. `root` is the file system with /proc and /sys.
double machine_memory(const std::filesystem::path& root = "/");

/// Bytes that this process holds now; 0 where that cannot be read.
double resident_memory(const std::filesystem::path& root = "/");

}  // namespace sonarsim
