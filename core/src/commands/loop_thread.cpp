// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/loop_thread.hpp"

namespace cortex {

double latencyOfBucket(std::uint32_t bucket) {
    if (bucket < 16) return (bucket + 1U) * 1e-3;
    const std::uint64_t octave = bucket / 16U - 1U;
    return static_cast<double>((bucket % 16U + 17ULL) << octave) * 1e-3;
}

void PresentCycle::post(LoopThread& thread, Severity severity, EventKind kind,
                        std::uint32_t simplex, const EventText& text) const {
    Event event;
    event.cycle = over ? cycle + 1 : cycle;
    event.time = nominalTime;
    event.clock = clock;
    event.simplex = simplex;
    event.order = simplex == noSimplex ? noSimplex : ranks[simplex];
    event.sequence = thread.sequence++;
    event.severity = severity;
    event.kind = kind;
    event.text = text;
    thread.events->post(event);
}

}  // namespace cortex
