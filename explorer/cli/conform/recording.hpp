// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/honesty.hpp"
#include "conform/plant.hpp"
#include "conform/sample.hpp"

#include <functional>
#include <memory>

namespace cortex::cli::conform {

// Every cycle of a plant as its agent sends it, from the beginning to the end of this object. Times
// are those of the agent, so a slow machine is no reason to fail. Main thread.
class Recording {
public:
    // Waits for the first cycle. `plant` outlives it. Throws Failure.
    Recording(Live& live, const Plant& plant);
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    Sample latest() const;
    // Until the newest cycle meets the condition; false: the agent's time has gone on by so many
    // seconds. Throws Failure where no cycle comes within the time to wait.
    bool becomes(const std::function<bool(const Sample&)>& condition, double seconds) const;
    // The agent's time goes on by so much.
    void pass(double seconds) const;
    // From now on each cycle is given to this function, on another thread, one at a time. It
    // replaces the last one; {}: to none, and when this returns it is not running either.
    void follow(std::function<void(const Sample&)> each);
    // Whether an interrupt ends what waits, as it does at first; not while something is put back.
    void setInterruptible(bool isIt) { isInterruptible_ = isIt; }
    bool isInterruptible() const { return isInterruptible_; }
    // What was seen until now.
    Honesty honesty() const;

private:
    struct Shared;
    void waitForNext(std::int64_t after) const;

    Live& live_;
    std::shared_ptr<Shared> shared_;
    bool isInterruptible_ = true;
};

}  // namespace cortex::cli::conform
