// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "octets.hpp"

#include <functional>
#include <memory>

namespace cortex::bare {

// A participant of bare Fast DDS on the loopback interface, UDP alone, with one best-effort topic
// that it writes or hears.
class Stream {
public:
    // On threads of DDS: what came, and when others were found.
    struct Callbacks {
        std::function<void(const Octets::Data&)> onData;
        std::function<void()> onMatch;
    };

    enum class Role { Writer, Reader };
    Stream(int domain, Role role, Callbacks callbacks = {});  // throws std::runtime_error
    ~Stream();

    bool write(Octets::Data& data);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::bare
