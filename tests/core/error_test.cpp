#include "core/error.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("error: a location names what is known of it") {
        CHECK(Location{"a.yaml"}.text() == "a.yaml");
        CHECK(Location{"a.yaml", 3}.text() == "a.yaml:3");
        CHECK(Location{"a.yaml", 3, 7}.text() == "a.yaml:3:7");
        // A column without a line is meaningless.
        CHECK(Location{"a.yaml", 0, 7}.text() == "a.yaml");
    }

    TEST_CASE("error: the message starts with the location") {
        CHECK(std::string(InputError({"a.yaml", 3, 7}, "no such key").what()) ==
              "a.yaml:3:7: no such key");
        CHECK(std::string(InputError("no such key").what()) == "no such key");
    }

    TEST_CASE("error: problems are gathered, each once, and told together") {
        Problems problems;
        CHECK_NOTHROW(problems.raise());
        CHECK(problems.attempt([] {}));
        for (const char* fault : {"one", "two", "one"})
            CHECK_FALSE(problems.attempt([&] { throw InputError(fault); }));
        CHECK(problems.count() == 2);
        CHECK_THROWS_WITH_AS(problems.raise(), "one\ntwo", InputError);
        // Other exceptions pass through.
        CHECK_THROWS_AS(problems.attempt([] { throw std::runtime_error("disk"); }),
                        std::runtime_error);
        for (int i = 0; i < 100; ++i)
            problems.add(InputError(std::to_string(i)));
        CHECK(problems.count() == 102);
        CHECK_THROWS_WITH_AS(problems.raise(),
                             doctest::Contains("47\nand 52 more faults like these"), InputError);
    }
}
