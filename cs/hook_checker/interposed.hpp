// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include <dlfcn.h>

namespace cortex::cs {

// The function that this library stands in for. A constant at its place: using it takes no lock.
class NextFunction {
public:
    constexpr explicit NextFunction(const char* name) : name_{name} {}

    void* get() {
        void* found = found_.load(std::memory_order_relaxed);
        if (found == nullptr) {
            found = dlsym(RTLD_NEXT, name_);
            found_.store(found, std::memory_order_relaxed);
        }
        return found;
    }

private:
    const char* name_;
    std::atomic<void*> found_{nullptr};
};

}  // namespace cortex::cs

// By its name, with the type that the C library declares.
#define CORTEX_NEXT(name)                                      \
    reinterpret_cast<decltype(&(name))>([]() -> void* {        \
        static constinit cortex::cs::NextFunction next{#name}; \
        return next.get();                                     \
    }())
