// SPDX-License-Identifier: Apache-2.0
// any_writer DOMAIN [FOLDER]: writes messages of any content on the loopback interface, with the
// security folder, until its standard input ends. A line there, "KIND SEED COUNT MOST": so many
// messages of that kind, each of a seed that follows the one before, of at most MOST octets.
#include "comms/any_messages.hpp"
#include "dds/participant.hpp"

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

using namespace cortex::comms;

namespace {

using Write = std::function<void(std::uint64_t seed, std::size_t most)>;

// Once somebody reads it. A writer whose samples are sent by a thread has a reader of its own.
Write writerOf(Participant& participant, const std::string& kind, bool secured) {
    Write write;
    forKind(kind, [&]<class M>(const Topic& topic) {
        std::shared_ptr<Writer<M>> writer = participant.writer<M>(topic);
        const bool readsItself = secured && (topic.qos == Qos::State || topic.qos == Qos::Log);
        while (writer->readers() < (readsItself ? 2U : 1U)) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
        }
        write = [writer](std::uint64_t seed, std::size_t most) {
            if (!writer->write(anyMessage<M>(seed, most))) std::exit(1);
        };
    });
    return write;
}

}  // namespace

int main(int argc, char** argv) {
    NetworkOptions network;
    network.domain = argc > 1 ? std::atoi(argv[1]) : 0;
    network.interfaces = {"127.0.0.1"};
    if (argc > 2) network.security = argv[2];
    Participant participant{network, anySender};
    std::string kind, last;
    std::uint64_t seed = 0;
    std::size_t count = 0, most = 0;
    Write write;
    while (std::cin >> kind >> seed >> count >> most) {
        if (kind != last) write = {};
        if (kind != last) write = writerOf(participant, kind, argc > 2);
        last = kind;
        for (std::size_t i = 0; i < count; ++i) write(seed + i, most);
    }
    return 0;
}
