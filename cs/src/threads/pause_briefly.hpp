// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cortex::cs {

// Leaves the core to its other hardware thread, and to the hypervisor, while nothing is to be done.
inline void pauseBriefly() noexcept {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

}  // namespace cortex::cs
