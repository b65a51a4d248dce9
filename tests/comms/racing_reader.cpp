// SPDX-License-Identifier: Apache-2.0
// Races on purpose: a listener counts what another thread reads. ThreadSanitizer must say so, with
// its suppressions for Fast DDS in force. It reports a race only if the other access is recent, so
// the reader does not sleep between its looks.
#include "comms/inbox.hpp"
#include "dds/participant.hpp"

#include <chrono>
#include <iostream>
#include <thread>

int main() {
    using namespace cortex::comms;
    Participant agent{loopback(), "agent"}, tool{loopback(), "tool"};
    int heard = 0;
    const auto reader = tool.reader<Presence>(topics::presence, [&](Presence&&) { ++heard; });
    const auto writer = agent.writer<Presence>(topics::presence);
    std::jthread talker{[&](const std::stop_token& stop) {
        for (Presence presence; !stop.stop_requested(); ++presence.cycle) writer->write(presence);
    }};
    const auto end = std::chrono::steady_clock::now() + cortex::test::patience;
    while (heard <= 1000 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    const bool counted = heard > 1000;
    std::cerr << (counted ? "heard" : "nothing was heard") << '\n';
    return counted ? 0 : 1;
}
