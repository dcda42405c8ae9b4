#include "core/error.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("error: a location prints its known parts") {
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

    TEST_CASE("error: errors are collected, each once, and thrown together") {
        ErrorList errors;
        CHECK_NOTHROW(errors.raise());
        CHECK(errors.attempt([] {}));
        for (const char* fault : {"one", "two", "one"})
            CHECK_FALSE(errors.attempt([&] { throw InputError(fault); }));
        CHECK(errors.count() == 2);
        CHECK_THROWS_WITH_AS(errors.raise(), "one\ntwo", InputError);
        // Other exceptions pass through.
        CHECK_THROWS_AS(errors.attempt([] { throw std::runtime_error("disk"); }),
                        std::runtime_error);
        for (int i = 0; i < 100; ++i)
            errors.add(InputError(std::to_string(i)));
        CHECK(errors.count() == 102);
        CHECK_THROWS_WITH_AS(errors.raise(), doctest::Contains("47\nand 52 more errors like these"),
                             InputError);
    }
}
