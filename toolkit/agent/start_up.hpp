// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/program_interface.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "summary.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cortex::toolkit {

// --startup: starts all, and says who did not follow. Once more when another agent has come that
// some wait for, or when data is good that was not when somebody did not follow. Program's thread;
// made before the cluster starts, for what its events say.
class StartUp {
public:
    StartUp(cs::ClusterCS& cluster, std::string agentName);
    StartUp(const StartUp&) = delete;
    StartUp& operator=(const StartUp&) = delete;

    void look();   // again and again, while the loop runs
    void again();  // from the beginning: everything was shut down in between
    // Who is there has followed or not, or it takes longer than anyone waits for.
    bool isOver() const { return over_; }
    // At the end: who was not started, and what is not there; "" if all were started.
    std::string endText() const;

private:
    using Clock = std::chrono::steady_clock;

    struct Hints;  // shared with the event thread, which may outlive this

    std::string missingText(const MissingLinks& missing) const;
    void send(const Image& image);
    void tell(const CallResult& answer);
    void tellOverdue();
    bool mayFollowNow(const Image& image);
    void noteActive(const Image& image);
    std::string shutDownSince(const Image& image) const;

    cs::ClusterCS& cluster_;
    std::string path_;
    std::optional<Clock::time_point> began_;  // the first look
    std::uint64_t sent_ = 0;
    bool answerIsDue_ = false, told_ = false, complete_ = false, over_ = false;
    MissingLinks missing_;                              // when the command was sent last
    std::optional<std::vector<std::uint32_t>> active_;  // of our simplexes; they never change
    std::set<std::uint32_t> started_;                   // what was Active since
    std::string notFollowed_;                           // what it was answered
    std::vector<std::uint32_t> notGood_;  // of our simplexes, when some did not follow
    Clock::time_point nextTry_;
    std::shared_ptr<Hints> hints_;
};

// Without --startup: says once what is in Standby and that nobody asked for a start-up, a while
// after the start, or at the end where that comes first. Made before the cluster starts.
class NotStarted {
public:
    // `options`: those with which `cortex` reaches this agent; none: nothing does.
    NotStarted(cs::ClusterCS& cluster, std::string agentName, std::optional<std::string> options);

    void look();
    void lookAtEnd() { tell(); }

private:
    using Clock = std::chrono::steady_clock;

    void tell();

    cs::ClusterCS& cluster_;
    std::string path_;
    std::optional<std::string> options_;
    Clock::time_point began_ = Clock::now();
    std::shared_ptr<std::atomic<bool>> asked_;  // the event thread's, which may outlive this
    bool told_ = false;
};

}  // namespace cortex::toolkit
