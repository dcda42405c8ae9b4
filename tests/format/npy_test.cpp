#include "output/format/npy.h"

#include "support/test.h"

using namespace sonarsim;

TEST_CASE("npy: the bytes are NumPy's format 1.0") {
    const std::vector<float> values{1.0F, 2.0F, 3.0F, -1.0F, 0.5F, 0.0F};
    const std::string bytes = npy_bytes(values, 2, 3);
    // 10 bytes of preamble and 118 of header make 128, a multiple of 64.
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    header.append(117 - header.size(), ' ');
    header += '\n';
    CHECK(bytes.substr(0, 10) == std::string("\x93NUMPY\x01\x00\x76\x00", 10));
    CHECK(bytes.substr(10, 118) == header);
    CHECK(bytes.size() == 128 + 6 * 4);
    // 1.0 is 0x3f800000, 2.0 is 0x40000000; little endian, row by row.
    CHECK(bytes.substr(128, 8) == std::string("\x00\x00\x80\x3f\x00\x00\x00\x40", 8));
}

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
