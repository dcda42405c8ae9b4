#include <unistd.h>

#include <cstring>

#include "exit_codes.h"

// Runs first; only this file is compiled for every x86-64 processor (CMakeLists.txt).

namespace {

constexpr const char* sentence =
    "sonarsim: this processor lacks AVX2, FMA or BMI2. The program is built for x86-64-v3 "
    "(Intel since 2013, AMD since 2015), so that its datasets have the same bytes everywhere.\n";

/// Prints a sentence instead of failing with an illegal instruction. Constructors run in the order
/// of their priorities, those without one last; 101 is the first free priority.
__attribute__((constructor(101))) void require_processor() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        return;
    // If stderr is closed, the message is lost.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, sentence, std::strlen(sentence));
    _exit(sonarsim::exit_failed);
}

}  // namespace
