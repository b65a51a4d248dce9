// SPDX-License-Identifier: Apache-2.0
// What ends the calls of a function that a mirror was given (mirror.hpp).
#pragma once

#include <memory>
#include <utility>

namespace cortex::comms {

class MirrorListener;

// Of Mirror::onImage() and Mirror::onEvent(). It may be dropped: then the mirror calls the function
// until the mirror itself ends.
class Listening {
public:
    Listening() = default;  // of nothing
    explicit Listening(std::weak_ptr<MirrorListener> listener) : listener_{std::move(listener)} {}

    // Ends it. When this returns the function does not run, will not run again, and it and what it
    // captured are destroyed. So this waits for a call that runs: hold no mutex that the function
    // takes. Called by the function itself it returns at once, and that call is the last one. Any
    // thread; it may be repeated, and called after the mirror has ended.
    void stop();

private:
    std::weak_ptr<MirrorListener> listener_;
};

}  // namespace cortex::comms
