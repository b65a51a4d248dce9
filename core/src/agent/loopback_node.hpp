// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command_exchange.hpp"
#include "cortex/core/spsc_ring.hpp"
#include "cortex/core/transport.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

// One agent on a loopback hub: what other agents may read of it, and what it links of theirs.
// read() and write() in its loop, the rest under the hub's mutex.
class LoopbackAgent {
public:
    explicit LoopbackAgent(const AgentAccess& access);

    const std::string& name() const { return access_.structure->agent; }
    bool owns(std::string_view path) const;
    CommandPipe& pipe() { return pipe_; }
    AgentCallPipe& calls() { return calls_; }
    bool connected() const { return connected_.load(); }
    void setConnected(bool connected) { connected_.store(connected); }
    void loseSender(const Sender& sender);
    // Binds our remote simplexes that `other` has; what does not fit becomes an event.
    void bind(const std::shared_ptr<LoopbackAgent>& other);
    void close();  // after our last cycle; returns when no other agent reads from this one

    void read(Inbox& inbox) CORTEX_REALTIME;
    void write(Outbox& outbox) CORTEX_REALTIME;

private:
    // Compiled off the loop, kept as long as this agent: the loop may still use it.
    struct Bound {
        std::shared_ptr<LoopbackAgent> owner;
        std::uint32_t theirs = noSimplex;
        LinkBinding binding;
    };
    struct Link {
        std::uint32_t simplex = noSimplex;
        std::atomic<const Bound*> bound{nullptr};
        const Bound* seen = nullptr;  // the loop's
        std::int64_t lastCycle = 0;
        bool live = false;
    };
    struct Note {
        Severity severity = Severity::Info;
        std::uint32_t simplex = noSimplex;
        EventText text;
    };
    void note(Severity severity, std::uint32_t simplex, std::string_view text);
    void readLink(Link& link, Inbox& inbox) CORTEX_REALTIME;
    void readFrom(const Bound& bound, Link& link, Inbox& inbox) CORTEX_REALTIME;

    AgentAccess access_;
    CommandPipe pipe_;
    AgentCallPipe calls_;
    std::vector<std::unique_ptr<Link>> links_;
    std::vector<std::unique_ptr<Bound>> bounds_;
    SpscRing<Note> notes_;
    SpscRing<Sender> lostSenders_;
    std::atomic<bool> connected_{true}, open_{true};
    std::atomic<std::uint32_t> readers_{0};
};

}  // namespace cortex
