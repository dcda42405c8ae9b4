#pragma once

namespace sonarsim::test {

/// Whether this build looks for faults of memory or threads. It is some twenty times slower then,
/// and a test whose point is a figure, on paths that others walk too, is left to the other builds.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace sonarsim::test
