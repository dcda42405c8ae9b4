#include "core/child_process.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"

using namespace sonarsim;

namespace {

constexpr ChildLimits roomy{std::size_t{1} << 28, 60};

std::string error_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits = roomy) {
    try {
        bytes_of_child(work, limits);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_SUITE("core") {
    TEST_CASE("a child process hands over more than a pipe holds") {
        const std::string part(100'000, 'x');
        const std::string bytes = bytes_of_child(
            [&](const ChildOutput& output) {
                for (int i = 0; i < 30; ++i)
                    output(part.data(), part.size());
            },
            roomy);
        CHECK(bytes == std::string(3'000'000, 'x'));
    }

    TEST_CASE("a child process that crashes, loops or takes all memory ends alone") {
        CHECK(error_of_child([](const ChildOutput&) { std::raise(SIGSEGV); }) ==
              "ended with \"Segmentation fault\"");
        CHECK(error_of_child([](const ChildOutput&) { std::abort(); }) == "ended with \"Aborted\"");
        CHECK(error_of_child(
                  [](const ChildOutput&) {
                      volatile int never = 0;
                      while (never == 0) {
                      }
                  },
                  {std::size_t{1} << 28, 1}) == "took more than 1 s");
        CHECK(error_of_child(
                  [](const ChildOutput& output) {
                      output("x", 1);
                      pause();  // as for a lock that nobody opens
                  },
                  {std::size_t{1} << 28, 60, 0.25}) == "took more than 0.25 s");
        CHECK(error_of_child([](const ChildOutput& output) {
                  const std::vector<char> much(std::size_t{1} << 32);
                  output(much.data(), 1);
              }) == "needed more memory than it may have");
    }
}
