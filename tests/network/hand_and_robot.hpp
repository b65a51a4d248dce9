// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"
#include "cortex/comms/network_options.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace cortex::test {

// Empty: no peer, no security.
comms::NetworkOptions network(const std::string& peer, const std::string& security = "");

using Clock = std::chrono::steady_clock;

// What happened in a loop, in order; one thread writes, others read when the loop has ended.
template <class T>
class Record {
public:
    void add(const T& element) {
        if (count_ < elements_.size()) elements_[count_++] = element;
    }
    std::vector<T> taken() const {
        return {elements_.begin(), elements_.begin() + static_cast<std::ptrdiff_t>(count_)};
    }

private:
    std::array<T, 500'000> elements_;
    std::size_t count_ = 0;
};

struct Press {
    std::int64_t released;  // in which cycle of the hand
    Clock::time_point at;
};
struct Written {
    std::int64_t cycle;
    Clock::time_point at;
};
// The button in a cycle of its reader in which it is pressed.
struct Seen {
    std::int64_t press;
    std::int64_t written;  // in which cycle of the hand
    std::int64_t came;     // when the reader's cycle that took it woke up, in its time
    std::int64_t at;       // this cycle
};
struct Executed {
    std::int64_t number, cycle;
};

// What the chief sent, and its answer.
struct Ordered {
    std::int64_t number;
    Outcome outcome;
};

// The agent "hand": its finger presses /hand/button for 20 to 150 cycles and lets it go as long.
// From beginOrders() on its chief commands the counter of the robot, one command after the other.
class HandAgent {
public:
    explicit HandAgent(const comms::NetworkOptions& network);
    ~HandAgent();

    void beginOrders() { record_->orders = true; }
    void endOrders();  // when the last one is answered
    void end();        // and then:
    std::vector<Ordered> ordered() const { return record_->ordered.taken(); }
    std::vector<Press> presses() const { return record_->presses.taken(); }  // by number, from 1
    std::vector<Written> written() const { return record_->written.taken(); }

    struct Recorded {
        Record<Press> presses;
        Record<Written> written;  // the button, in every cycle
        Record<Ordered> ordered;
        std::atomic<bool> orders{false}, waiting{false};
    };
    static constexpr std::int64_t firstOrder = 1'000'000'000;

private:
    SimplexTree tree_;
    std::unique_ptr<Recorded> record_ = std::make_unique<Recorded>();
    cs::ClusterCS cluster_;
};

// The agent "robot", a process of its own like on a host of its own: watches the button, and counts
// commands.
class RobotProcess {
public:
    explicit RobotProcess(const std::string& peer, const std::string& security = "");
    ~RobotProcess();
    RobotProcess(const RobotProcess&) = delete;
    RobotProcess& operator=(const RobotProcess&) = delete;

    std::int64_t newest() const;  // of the button, which is good: cycle of the hand; else 0
    int presses() const;          // that were seen
    void end();
    pid_t pid() const { return process_; }
    std::vector<Seen> seen() const;
    Clock::time_point timeOf(std::int64_t wakeUp) const;
    std::vector<Executed> executed() const;

    struct Memory;  // of both processes

private:
    int file_ = -1;
    Memory* memory_ = nullptr;
    pid_t process_ = 0;
};

// A tool that watches everything and, from begin() on, sends `increment` fifty times a second.
class Station {
public:
    explicit Station(const comms::NetworkOptions& network);
    ~Station();

    void begin() { sends_ = true; }
    // Whether the robot and all of its values are here, newer than that cycle.
    bool sees(std::int64_t newerThan);
    std::int64_t cycleOfRobot();
    struct Sent {
        Outcome outcome = Outcome::None;
        std::int64_t latest = 0;  // cycle of the robot in which it may still be executed
    };
    int done() const { return done_; }
    std::map<std::int64_t, Sent> end();         // by number; when all are answered, 20 s at most
    std::int64_t count();                       // of the robot
    std::vector<std::string> warnings() const;  // of all agents

private:
    void send();
    void poll();

    mutable std::mutex mutex_;
    std::vector<std::string> warnings_;
    comms::Mirror mirror_;
    std::map<std::int64_t, Sent> sent_;
    std::map<std::uint64_t, std::int64_t> pending_;
    std::atomic<int> done_{0};
    std::atomic<bool> sends_{false}, stop_{false};
    std::thread thread_;
};

}  // namespace cortex::test
