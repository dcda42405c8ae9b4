#include "core/build_info.h"

#ifdef __FAST_MATH__
#error "-ffast-math lets a compiler change results: two builds would write different bytes"
#endif

namespace sonarsim {

namespace {

// Eigen is header-only and chooses its instructions by these macros.
#if defined(__AVX512F__)
constexpr const char* arithmetic = "AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
constexpr const char* arithmetic = "x86-64-v3";
#else
#error "the build needs at least x86-64-v3: AVX2 and FMA"
#endif

}  // namespace

BuildInfo build_info() {
    return {.version = SONARSIM_VERSION,
            .compiler = SONARSIM_COMPILER,
            .flags = SONARSIM_FLAGS,
            .arithmetic = arithmetic};
}

}  // namespace sonarsim
