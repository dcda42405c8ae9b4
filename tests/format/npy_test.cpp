#include "format/npy.h"

#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "core/error.h"
#include "core/file.h"
#include "support/npy_data.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;
using test::Matrix;
using test::read_npy;

TEST_SUITE("dataset") {
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
            const std::vector<float> values(rows * 3);
            const std::string bytes = npy_bytes(values, rows, 3);
            CHECK((bytes.size() - values.size() * 4) % 64 == 0);
            CHECK(bytes[bytes.size() - values.size() * 4 - 1] == '\n');
        }
    }

    TEST_CASE("npy: what is written is read back bit by bit") {
        const TemporaryFolder folder;
        const std::vector<float> values{0.0F,
                                        -0.0F,
                                        std::numeric_limits<float>::denorm_min(),
                                        std::numeric_limits<float>::max(),
                                        std::numeric_limits<float>::infinity(),
                                        std::numeric_limits<float>::quiet_NaN(),
                                        0.1F,
                                        1.0F / 3.0F};
        write_file(folder.path / "a.npy", npy_bytes(values, 4, 2));
        const Matrix matrix = read_npy(folder.path / "a.npy");
        CHECK(matrix.rows == 4);
        CHECK(matrix.columns == 2);
        REQUIRE(matrix.values.size() == values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            CHECK(std::bit_cast<std::uint32_t>(matrix.values[i]) ==
                  std::bit_cast<std::uint32_t>(values[i]));
        }
    }
}
