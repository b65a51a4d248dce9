// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace cortex::cs {

/// How long a cache line takes from the CPU of a loop's own thread to that of another of its
/// threads and back, in microseconds, the mean over those others of which it is known (see
/// cpuForThread()): some 0.06 where they have a cache in common, several times that where they have
/// not. The host of a virtual machine may move its CPUs from one such neighbourhood to another at
/// any time.
///
/// The least of several rounds, on two threads made for it: some 0.3 ms for each of the others
/// where CPUs are free, 20 ms of waiting for busy ones. 0: not known, as there is one CPU, or none
/// of the others had time. Not for a thread of the loop.
double lineMicroseconds(const std::vector<int>& affinity, std::uint32_t threads);

}  // namespace cortex::cs
