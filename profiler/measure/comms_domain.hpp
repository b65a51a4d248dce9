// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include <string>

namespace cortex::profiler {

// Where measurements of the network take place. The first call asks for a loopback interface of
// this thread and of what it starts from then on, which needs a privilege; without it that of the
// machine is used, in a domain of its own.
struct Domain {
    int number = 1;  // the next one is free too
    bool alone = false;
    std::string text() const;
};
Domain measurementDomain();

comms::NetworkOptions loopback(int domain);

}  // namespace cortex::profiler
