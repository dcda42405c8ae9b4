#pragma once

// Headers that most tests need; also their precompiled header.

#include <doctest/doctest.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>
#include <span>

#include "core/error.h"
#include "core/file.h"
#include "core/units.h"
#include "simulate/visibility/make_engine.h"
#include "simulate/visibility/view.h"
#include "support/shapes.h"

namespace sonarsim::test {

/// True in builds with a sanitizer. They are some twenty times slower, so tests about figures,
/// whose code other tests cover, are left to other builds.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

/// A temporary folder for a test, removed with all its contents.
struct TemporaryFolder {
    std::filesystem::path path;

    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "sonarsim-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// doctest's Approx with a relative tolerance at every scale: |a - b| < epsilon max(|a|, |b|).
/// doctest adds 1 to the maximum, so that its Approx(1e-8) equals 0.
inline doctest::Approx approx(double value) {
    return doctest::Approx(value).scale(std::numeric_limits<double>::min());
}

/// The folder of the sources under test.
std::filesystem::path source_folder();

/// The values as text, for messages.
template <class... Values>
std::string listed(const Values&... values) {
    std::string out;
    ((out += std::string(out.empty() ? "" : ", ") + doctest::toString(values).c_str()), ...);
    return out;
}

/// The words of the InputError that `work` ends in; "" when it does not.
template <class Work>
std::string fault_of(Work work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Each input of `faulty` is refused with its words, behind `where`.
template <class Faulty, class Read>
void check_faults(const Faulty& faulty, const std::string& where, Read read) {
    for (const auto& one : faulty)
        CHECK(fault_of([&] { read(one.first); }) == where + one.second);
}

/// The sum of numbers, in doubles.
template <class Range>
double total(const Range& numbers) {
    return std::accumulate(std::begin(numbers), std::end(numbers), 0.0);
}

/// The integral of a function by the midpoint rule.
template <class Function>
auto integral(double from, double to, int steps, const Function& function) {
    const double step = (to - from) / steps;
    decltype(function(from)) sum{};
    for (int k = 0; k < steps; ++k)
        sum += function(from + (k + 0.5) * step);
    return sum * step;
}

/// A pose that looks down by an angle.
inline Pose pitched(double pitch_deg, const Eigen::Vector3d& position = {0.0, 0.0, 0.0}) {
    return {rotation_from_rpy(0.0, radians(pitch_deg), 0.0), position};
}

/// A fan of all its beams, the two sides of it, or a cone as wide as it.
inline View with_shape(View view, ViewShape shape) {
    view.shape = shape;
    if (shape != ViewShape::fan) view.beams = shape == ViewShape::cone ? 1 : 2;
    if (shape == ViewShape::cone) view.elevation_rad = view.azimuth_rad;
    return view;
}

inline std::unique_ptr<VisibilityEngine> engine_of(const Scene& scene, EngineKind type) {
    return make_engine(scene, {.type = type});
}

}  // namespace sonarsim::test

/// CAPTURE of several values.
#define CAPTURE_ALL(...) INFO(#__VA_ARGS__ " = ", sonarsim::test::listed(__VA_ARGS__))

// All tests are about these.
using namespace sonarsim;
using namespace sonarsim::test;
