#include "core/machine_memory.h"

#include "support/test.h"

namespace {

void write(const std::filesystem::path& file, const char* text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("machine memory: the least of the machine's and of what groups of processes may have") {
    const TemporaryFolder folder;
    const std::filesystem::path root = folder.path;
    // The limit of this process stands above all, and is none where tests run.
    CHECK(machine_memory(root) > 1e9);
    write(root / "proc/meminfo", "MemFree:  1 kB\nMemTotal:  2000 kB\n");
    CHECK(machine_memory(root) == 2000.0 * 1024.0);
    write(root / "proc/self/cgroup", "0::/outer/inner\n");
    write(root / "sys/fs/cgroup/outer/inner/memory.max", "max\n");
    CHECK(machine_memory(root) == 2000.0 * 1024.0);
    write(root / "sys/fs/cgroup/outer/memory.max", "1000000\n");
    CHECK(machine_memory(root) == 1e6);
    CHECK(machine_memory() > 1e8);
    CHECK(resident_memory() > 1e5);
}
