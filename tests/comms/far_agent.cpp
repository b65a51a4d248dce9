// SPDX-License-Identifier: Apache-2.0
// far_agent DOMAIN: an agent "far" with /axis and /probe on the loopback interface, about a
// thousand cycles a second, until its standard input ends.
#include "cortex/comms/dds_interface.hpp"

#include "support/probe.hpp"

#include <cstdlib>

#include <poll.h>
#include <unistd.h>

int main(int argc, char** argv) {
    using namespace cortex;
    comms::NetworkOptions network;
    network.domain = argc > 1 ? std::atoi(argv[1]) : 0;
    network.interfaces = {"127.0.0.1"};
    test::ProbeCluster far{{}, "far"};
    far.tree.add("/axis", "Observation").set("position", 2.0);
    far.probe("/probe");
    far.cluster->addInterface<comms::DdsInterface>(network);
    far.start();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (poll(&input, 1, 1) == 0) far.step();
    return 0;
}
