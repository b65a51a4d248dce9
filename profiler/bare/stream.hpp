// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "octets.hpp"

#include <functional>
#include <memory>

namespace cortex::profiler {

// A participant of bare Fast DDS on the loopback interface, UDP alone, with one best-effort topic
// that it writes or hears.
class Stream {
public:
    using OnData = std::function<void(const Octets::Data&)>;  // on a thread of DDS

    enum class Role { Writer, Reader };
    Stream(int domain, Role role, OnData onData = {});  // throws std::runtime_error
    ~Stream();

    bool write(Octets::Data& data);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::profiler
