#include "output/format/npy.h"

#include "support/test.h"

TEST_CASE("npy: the data begin at a multiple of 64 bytes, whatever the shape") {
    for (const std::size_t rows : {1, 10, 1000, 10000, 100000}) {
        const std::string header = npy_header({"<f4", {rows, 3}, true});
        CHECK(header.size() % 64 == 0);
        CHECK(header.back() == '\n');
        CHECK(header.find("'fortran_order': True, 'shape': (" + std::to_string(rows) + ", 3), }") !=
              std::string::npos);
    }
    CHECK(npy_header({"<f8", {120, 480, 5}}).find("'<f8'") != std::string::npos);
    CHECK(npy_header({"<f8", {120, 480, 5}}).find("(120, 480, 5), }") != std::string::npos);
}
