#include "format/npy_reader.h"

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/random.h"

using namespace sonarsim;

namespace {

/// A .npy file with this header in a given version, as other programs write it.
std::string foreign_npy(int version, std::string header, std::string_view data) {
    std::string bytes("\x93NUMPY", 6);
    bytes += static_cast<char>(version);
    bytes += '\0';
    bytes += static_cast<char>(header.size() & 0xff);
    bytes += static_cast<char>(header.size() >> 8);
    if (version > 1) bytes += std::string(2, '\0');
    return bytes + header + std::string(data);
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

TEST_SUITE("format") {
    TEST_CASE("npy reader: types, versions and orders of other programs") {
        const auto fortran =
            foreign_npy(2, "{'shape': (2, 3), 'fortran_order': True, 'descr': '<u2'}",
                        bytes_of<std::uint16_t>({1, 4, 2, 5, 3, 6}));
        const NpyView view = read_npy(fortran);
        REQUIRE(view.values == 6);
        for (std::size_t k = 0; k < 6; ++k)
            CHECK(npy_value(view, k) == static_cast<double>(k + 1));
        const auto line =
            foreign_npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }\n",
                        bytes_of<double>({1e9 + 0.25, -3}));
        CHECK(npy_value(read_npy(line), 0) == 1e9 + 0.25);
        const auto bytes =
            foreign_npy(3, "{'descr':'|u1','fortran_order':False,'shape':(1,1,2)}", "\x07\xff");
        CHECK(npy_value(read_npy(bytes), 1) == 255.0);
    }

    TEST_CASE("npy reader: a file that is not whole or of another type is refused") {
        const auto faulty = [](const std::string& header, std::string_view data) {
            const std::string bytes = foreign_npy(1, header, data);
            CHECK_THROWS_AS(read_npy(bytes), std::runtime_error);
        };
        faulty("{'descr': '>f4', 'fortran_order': False, 'shape': (1,)}", "abcd");
        faulty("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", "abcdefgh");
        faulty("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (1,)}", "abcd");
        faulty("{'descr': '<f4', 'fortran_order': False, 'shape': (2,)}", "abcd");
        faulty("{'descr': '<f4', 'fortran_order': False, 'shape': (0,)}", "");
        faulty("{'descr': '<f4', 'fortran_order': False, 'shape': ()}", "abcd");
        faulty("{'descr': '<f4', 'fortran_order': False, 'shape': (-1,)}", "abcd");
        faulty("{'descr': '<f4', 'fortran_order': False, 'shape': (18446744073709551615, 4)}", "");
        faulty("{'descr': '<f4', 'shape': (1,)}", "abcd");
        faulty("{'descr': '", "");
        CHECK_THROWS_AS(read_npy("\x93NUMPY\x01"), std::runtime_error);
        CHECK_THROWS_AS(read_npy(""), std::runtime_error);
    }

    TEST_CASE("npy reader: any bytes end in a view or a message") {
        const std::string sound = npy_bytes(std::vector<float>{1, 2, 3, 4}, 2, 2);
        for (std::uint32_t k = 0; k < 20000; ++k) {
            const PhiloxBlock draw = philox({k, 0, 0, 0}, {0x6e7079U, 0});
            std::string bytes = sound;
            bytes[draw.x0 % 100] = static_cast<char>(draw.x1);
            if (draw.x2 % 4 == 0) bytes.erase(draw.x3 % bytes.size());
            try {
                const NpyView view = read_npy(bytes);
                for (std::size_t i = 0; i < view.values; ++i)
                    npy_value(view, i);
            } catch (const std::runtime_error&) {
                continue;
            }
        }
    }
}
