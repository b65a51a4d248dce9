// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/realtime.hpp"

#include <functional>
#include <memory>
#include <string_view>

namespace cortex::cs {

// Work that may block, such as to read a file, for a simplex whose hooks may not. One thread of the
// process does all of it, one at a time, and looks every 5 ms. What the
// work reads and writes is its own from begin() until isRunning() is false. In which cycle that is,
// differs from run to run. Work that talks to a device has its thread: IoSimplex::atDevice().
//
//     populate():   load_ = cs::SlowWork{[this] { points_ = readPoints(file_); }};
//     in a hook:    load_.begin();   later   if (!load_.isRunning()) … load_.failure() …
class SlowWork {
public:
    SlowWork() = default;
    explicit SlowWork(std::function<void()> work);  // setup phase
    SlowWork(SlowWork&& other) noexcept;
    SlowWork& operator=(SlowWork&& other) noexcept;
    ~SlowWork();  // after the work that runs

    // In a hook. False, and nothing is begun: it runs still, or is bound to nothing.
    bool begin() CORTEX_REALTIME;
    bool isRunning() const CORTEX_REALTIME;
    // Of the last one that ended: what it threw, at most 200 bytes; "": it did not throw.
    std::string_view failure() const CORTEX_REALTIME;

    struct Job;  // of the thread

private:
    friend class ThreadedSimplex;
    explicit SlowWork(std::shared_ptr<Job> job);

    std::shared_ptr<Job> job_;
};

}  // namespace cortex::cs
