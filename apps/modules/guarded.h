#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <new>

/// Runs a function. Returns 0, or 1 for an exception, which may not pass, with its reason.
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
