#include "core/error.h"

#include <doctest/doctest.h>

#include <string>

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("error: a location names what is known of it") {
        CHECK(Location{"a.yaml"}.text() == "a.yaml");
        CHECK(Location{"a.yaml", 3}.text() == "a.yaml:3");
        CHECK(Location{"a.yaml", 3, 7}.text() == "a.yaml:3:7");
        // A column without a line says nothing.
        CHECK(Location{"a.yaml", 0, 7}.text() == "a.yaml");
    }

    TEST_CASE("error: the message starts with the location") {
        CHECK(std::string(InputError({"a.yaml", 3, 7}, "no such key").what()) ==
              "a.yaml:3:7: no such key");
        CHECK(std::string(InputError("no such key").what()) == "no such key");
    }
}
