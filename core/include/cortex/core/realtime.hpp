// SPDX-License-Identifier: Apache-2.0
#pragma once

// CORTEX_REALTIME marks a function that runs inside a tick, on the loop thread or a worker.
// It promises: no allocation, no lock, no unbounded loop, no throw, and no system call but the
// clock. Clang 20 and later check the promise at compile time; elsewhere the word is for the reader
// and the test suite proves it at run time.
#if defined(__clang__) && __clang_major__ >= 20
#define CORTEX_REALTIME [[clang::nonblocking]]
#else
#define CORTEX_REALTIME
#endif
