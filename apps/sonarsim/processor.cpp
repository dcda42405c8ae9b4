#include <unistd.h>

#include <cstring>

#include "exit_codes.h"

// This file alone is compiled for every x86-64 processor (CMakeLists.txt), and what it runs is run
// before anything else of the program.

namespace {

constexpr const char* sentence =
    "sonarsim: this processor lacks AVX2, FMA or BMI2. The program is built for x86-64-v3 "
    "(Intel since 2013, AMD since 2015), so that its datasets have the same bytes everywhere.\n";

/// A sentence instead of an illegal instruction. Programs run their constructors in the order of
/// their priorities; 101 is the first that is free, and what has none comes last.
__attribute__((constructor(101))) void require_processor() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        return;
    // Where nobody listens there is nobody to tell.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, sentence, std::strlen(sentence));
    _exit(sonarsim::exit_failed);
}

}  // namespace
