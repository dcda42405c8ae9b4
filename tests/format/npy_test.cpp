#include "output/format/npy.h"

#include "support/test.h"

TEST_CASE("npy: the data begin at a multiple of 64 bytes, whatever the shape") {
    for (const std::size_t rows : {1, 10, 1000, 10000, 100000})
        CHECK(npy_header({"<f4", {rows, 3}, true}).size() % 64 == 0);
}
