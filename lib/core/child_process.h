#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sonarsim {

/// Limits of a child process, for each of its answers.
struct ChildLimits {
    std::size_t memory_bytes = 0;  ///< in addition to the memory at its start
    unsigned long cpu_s = 0;
    /// Wall-clock time, which also ends a child that waits for a lock; 0: no limit.
    double wall_s = 0.0;
};

/// Sends bytes to the parent.
using ChildOutput = std::function<void(const void* bytes, std::size_t size)>;

/// A child process that works on requests, one after the other. It is for a library that takes long
/// to load, and that may crash, loop or use up memory on a damaged file. Changes that the work
/// makes to memory are lost. The work must not use threads, or locks that other threads may hold.
/// Not thread-safe.
class ChildProcess {
  public:
    using Work = std::function<void(const std::string& request, const ChildOutput& output)>;

    ChildProcess(Work work, const ChildLimits& limits);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// The bytes that the work outputs for a request. It starts the child if there is none.
    /// InputError, with the reason, if the child ends before it has answered; the next request then
    /// starts another child. std::system_error if no child can be started.
    std::string answer(const std::string& request);

    /// Ends the child, until another request.
    void end();

  private:
    void start();
    [[noreturn]] void refuse(bool in_time);

    Work work_;
    ChildLimits limits_;
    int child_ = -1;    ///< its process, or -1
    int channel_ = -1;  ///< requests and answers
};

/// The answer of a child process that handles one request.
std::string bytes_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits);

}  // namespace sonarsim
