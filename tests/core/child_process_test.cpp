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

    TEST_CASE("one child answers all requests until it dies, and another one answers the next") {
        int answered = 0;  // in the child
        ChildProcess child(
            [&](const std::string& request, const ChildOutput& output) {
                if (request == "die") std::raise(SIGSEGV);
                for (++answered; output && request == "loop";) {
                }
                const std::string text =
                    request + " " + std::to_string(answered) + " " + std::to_string(getpid());
                output(text.data(), text.size());
            },
            {std::size_t{1} << 28, 1});
        const auto answer = [&](const std::string& request) {
            try {
                return child.answer(request);
            } catch (const InputError& error) {
                return std::string(error.what());
            }
        };
        const std::string first = answer("a");
        const std::string process = first.substr(4);
        CHECK(first == "a 1 " + process);
        CHECK(answer("b") == "b 2 " + process);
        const std::string much(300'000, 'x');  // more than a channel holds
        CHECK(answer(much) == much + " 3 " + process);
        CHECK(answer("die") == "ended with \"Segmentation fault\"");
        CHECK(answered == 0);
        const std::string second = answer("c");
        CHECK(second.substr(0, 4) == "c 1 ");
        CHECK(second.substr(4) != process);
        CHECK(answer("loop") == "took more than 1 s");
        CHECK(answer("d").substr(0, 4) == "d 1 ");
        child.end();
        child.end();
        CHECK(answer("e").substr(0, 4) == "e 1 ");
    }
}
