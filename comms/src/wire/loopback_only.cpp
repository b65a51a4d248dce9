// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/network_options.hpp"

#include "wire/udp_sockets.hpp"

#include <cstdint>
#include <map>
#include <string>

#include <netinet/in.h>

namespace cortex::comms {

OnLoopback onLoopback(int domain, const std::string& sockets) {
    bool any = false, others = false;
    for (const UdpSocket& each : participantSockets(sockets)) {
        if (domainOf(each) != domain) continue;
        (each.address == htonl(INADDR_LOOPBACK) ? any : others) = true;
    }
    if (!any) return OnLoopback::None;
    return others ? OnLoopback::Some : OnLoopback::All;
}

Sides sidesOf(int domain, const std::string& file) {
    std::map<std::uint32_t, Sides> ports;
    for (const UdpSocket& each : participantSockets(file)) {
        if (domainOf(each) != domain) continue;
        Sides& port = ports[each.port];
        (each.address == htonl(INADDR_LOOPBACK) ? port.loopback : port.others) = true;
    }
    Sides sides;
    for (const auto& [number, port] : ports) {
        if (port.loopback && port.others) continue;
        sides.loopback = sides.loopback || port.loopback;
        sides.others = sides.others || port.others;
    }
    return sides;
}

}  // namespace cortex::comms
