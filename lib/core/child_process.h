#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace sonarsim {

/// Limits of a child process, for each of its answers.
struct ChildLimits {
    std::size_t memory_bytes = 0;  ///< beyond what it starts with
    unsigned long cpu_s = 0;
    /// Time by the clock, also for a child that waits for a lock nobody opens; 0: any.
    double wall_s = 0.0;
};

/// Gives bytes to the parent.
using ChildOutput = std::function<void(const void* bytes, std::size_t size)>;

/// A child process that works on requests, one after the other: for a library that takes long to
/// load, and which a damaged file makes crash, loop or take all memory. Changes that the
/// work makes in memory are lost; it must not use threads or locks that other threads may hold. Not
/// thread-safe.
class ChildProcess {
  public:
    using Work = std::function<void(const std::string& request, const ChildOutput& output)>;

    ChildProcess(Work work, const ChildLimits& limits);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// The bytes that the work hands over for a request. It starts the child if there is none.
    /// InputError if the child ends before it has answered; the sentence says how. The next request
    /// then starts another one. std::system_error if there can be no child.
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

/// The answer of a child that has one request.
std::string bytes_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits);

}  // namespace sonarsim
