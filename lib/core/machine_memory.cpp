#include "core/machine_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace sonarsim {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double total_memory(const std::filesystem::path& root) {
    std::ifstream file(root / "proc/meminfo");
    std::string name;
    double kib = 0.0;
    while (file >> name >> kib) {
        if (name == "MemTotal:") return 1024.0 * kib;
        std::getline(file, name);
    }
    return no_limit;
}

/// The least limit of this process's control groups (version 2). "max" is no limit.
double group_limit(const std::filesystem::path& root) {
    std::ifstream groups(root / "proc/self/cgroup");
    double min_bytes = no_limit;
    for (std::string line; std::getline(groups, line);) {
        if (!line.starts_with("0::/")) continue;
        const std::filesystem::path top = root / "sys/fs/cgroup";
        std::filesystem::path group = top / line.substr(4);
        while (true) {
            double bytes = 0.0;
            if (std::ifstream(group / "memory.max") >> bytes)
                min_bytes = std::min(min_bytes, bytes);
            if (group == top || !group.has_relative_path()) break;
            group = group.parent_path();
        }
    }
    return min_bytes;
}

double process_limit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return no_limit;
    return static_cast<double>(limit.rlim_cur);
}

}  // namespace

double machine_memory(const std::filesystem::path& root) {
    return std::min({total_memory(root), group_limit(root), process_limit()});
}

double resident_memory(const std::filesystem::path& root) {
    std::ifstream file(root / "proc/self/statm");
    double all = 0.0;
    double resident = 0.0;
    if (!(file >> all >> resident)) return 0.0;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace sonarsim
