#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sonarsim {

/// Limits of a child process, beyond what it starts with.
struct ChildLimits {
    std::size_t memory_bytes = 0;
    unsigned long cpu_s = 0;
    /// Time by the clock, also for a child that waits for a lock nobody opens; 0: any.
    double wall_s = 0.0;
};

/// Gives bytes to the parent.
using ChildOutput = std::function<void(const void* bytes, std::size_t size)>;

/// Runs `work` in a child process and returns the bytes that it hands over. A library that a
/// damaged file makes crash, loop or take all memory does so there. InputError if the child ends in
/// another way than by returning from `work`; the sentence says how it ended. std::system_error if
/// there can be no child. Changes that `work` makes in memory are lost; it must not use threads or
/// locks that other threads may hold.
std::string bytes_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits);

}  // namespace sonarsim
