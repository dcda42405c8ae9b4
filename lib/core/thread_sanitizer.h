#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SONARSIM_THREAD_SANITIZER
#endif
#endif

// Marks a function that TBB calls. Such a function reads its arguments before it can call
// tsan_acquire(), and the thread sanitizer would report this. The sanitizer skips the function
// itself and still checks everything that it calls.
#ifdef SONARSIM_THREAD_SANITIZER
#define SONARSIM_CALLED_BY_TBB __attribute__((no_sanitize("thread")))
#else
#define SONARSIM_CALLED_BY_TBB
#endif

#ifdef SONARSIM_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace sonarsim {

// Debian's TBB is not built for the thread sanitizer, so the sanitizer does not see that TBB orders
// the threads it hands work to. These functions announce that order; in other builds they do
// nothing.

/// Makes what this thread has written visible to threads that call tsan_acquire() with the same
/// address.
inline void tsan_release([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_release(const_cast<void*>(address));
#endif
}

inline void tsan_acquire([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_acquire(const_cast<void*>(address));
#endif
}

/// Calls tsan_release() at the end of a scope, even if an exception ends it.
struct ReleaseAtEnd {
    const void* address;
    ~ReleaseAtEnd() { tsan_release(address); }
};

/// Calls tsan_acquire() at the end of a scope, even if an exception ends it.
struct AcquireAtEnd {
    const void* address;
    ~AcquireAtEnd() { tsan_acquire(address); }
};

}  // namespace sonarsim
