#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <new>

/// Runs a function, as no exception may reach the program. Returns 0, or 1 for an exception with
/// its reason, which ends with a zero.
int guarded(char* error, std::size_t error_size, const auto& run) {
    try {
        run();
        return 0;
    } catch (const std::bad_alloc&) {
        std::snprintf(error, error_size, "it needs more memory than there is");
    } catch (const std::exception& fault) {
        std::snprintf(error, error_size, "%s", fault.what());
    }
    return 1;
}
