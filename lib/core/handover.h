#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SONARSIM_THREAD_SANITIZER
#endif
#endif

// On a function that TBB calls and that reads what it was given before it can say that it was
// handed over: the sanitizer does not look at the function itself, but at all that it calls.
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

// The thread sanitizer sees no order between threads that TBB hands work to: Debian's TBB is not
// built for it. These tell it of one, and are nothing in other builds. The order itself is TBB's.

/// What this thread has written may be read by those that call `received` for the same address.
inline void handed_over([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_release(const_cast<void*>(address));
#endif
}

inline void received([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_acquire(const_cast<void*>(address));
#endif
}

/// Calls `handed_over` at the end of a scope, also when an exception ends it.
struct HandOverAtEnd {
    const void* address;
    ~HandOverAtEnd() { handed_over(address); }
};

/// Calls `received` at the end of a scope, also when an exception ends it.
struct ReceiveAtEnd {
    const void* address;
    ~ReceiveAtEnd() { received(address); }
};

}  // namespace sonarsim
