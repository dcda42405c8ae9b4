#include "core/hash.h"

#include <doctest/doctest.h>

using namespace sonarsim;

TEST_SUITE("core") {
    TEST_CASE("hash: FNV-1a with its published values") {
        CHECK(fnv1a_128("") == "6c62272e07bb014262b821756295c58d");
        CHECK(fnv1a_128("a") == "d228cb696f1a8caf78912b704e4a8964");
    }
}
