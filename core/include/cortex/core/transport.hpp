// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/command.hpp"
#include "cortex/core/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex {

class ImagePool;
class LoopPace;
class StandstillNote;

// Largest request or response record, bytes; a type that needs more is refused when it is loaded.
inline constexpr std::uint32_t maxRecord = 4096;

// How many commands after the last one that it has every answer below a sender may have sent.
inline constexpr std::uint32_t senderWindow = 128;

// A command from outside as the loop sees it: fixed size, its record already laid out as the
// target's CommandTable says. A transport decodes and checks shapes before it puts one into the
// Inbox.
struct OutsideCommand {
    Sender sender;
    std::int64_t targetEpoch = 0;
    std::uint64_t sequence = 0;       // per sender, from 1
    std::uint64_t answeredBelow = 0;  // the sender has every answer below this sequence
    std::int64_t notAfter = 0;        // cycle of the target's own counter
    std::int64_t until = 0;           // ns of the target's own clock; 0: not said
    std::uint32_t simplex = noSimplex;
    std::uint32_t command = CommandTable::none;
    std::uint32_t size = 0;
    const std::byte* request = nullptr;    // valid during the call only
    std::array<char, 32> onBehalfOf = {};  // who is behind it, as its sender says; often empty
    // The transport has answered it. Its number is used, so later ones do not wait for it; of the
    // rest only sender, targetEpoch, sequence and answeredBelow count.
    bool refused = false;
};

struct OutsideAnswer {
    Sender sender;
    std::uint64_t sequence = 0;
    std::uint32_t simplex = noSimplex;
    std::uint32_t command = CommandTable::none;
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    EventText why;
    std::int64_t latencyCycles = 0, latency = 0;  // ns
    std::uint32_t size = 0;
    const std::byte* response = nullptr;  // valid during the call only
};

// A command of one of our own tasks to a simplex of another agent. Numbers and record are those of
// our type of it: a transport passes names on.
struct AgentCall {
    std::uint64_t ticket = 0;           // its answer says it again
    std::uint32_t simplex = noSimplex;  // a remote simplex of our structure
    std::uint32_t command = CommandTable::none;
    std::uint32_t size = 0;
    const std::byte* request = nullptr;  // valid during the call only
};

struct AgentCallAnswer {
    std::uint64_t ticket = 0;
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    EventText why;
    std::uint32_t size = 0;               // 0: no response
    const std::byte* response = nullptr;  // laid out as our type says; valid during the call only
};

// Copies of a linked simplex's items from another agent's layout into ours: compiled once, off the
// loop, by item name.
struct LinkBinding {
    struct Copy {
        Kind kind;
        std::uint32_t from, to, length;  // offsets as in ItemLayout
    };
    std::vector<Copy> copies, constants;
    std::int64_t period = 0;  // ns between two writings by its owner; the transport says it
    bool usable = false;      // false: contradiction or wrong type; `findings` says why
    Report findings;
};
LinkBinding compileLink(const TypeLayout& ours, const TypeLayout& theirs, const TypeModel& ourTypes,
                        const TypeModel& theirTypes);

// What read() fills. Implemented by core; every call is wait-free.
class Inbox {
public:
    virtual ~Inbox() = default;
    virtual std::int64_t cycle() const CORTEX_REALTIME = 0;
    // An agent has this remote simplex of our structure; no value of it needs to have come.
    virtual void linkOffered(std::uint32_t simplex) CORTEX_REALTIME { (void)simplex; }
    // `simplex` is the index of a remote simplex of our structure. `age`: ns since it was measured,
    // on the receiver's clock; may be longer than the owner has run.
    virtual void link(std::uint32_t simplex, const LinkBinding& binding, const Slice& from,
                      std::int64_t age) CORTEX_REALTIME = 0;
    // Once, before the first link(): the constant items.
    virtual void linkConstants(std::uint32_t simplex, const LinkBinding& binding, const Slice& from)
        CORTEX_REALTIME = 0;
    virtual void linkLost(std::uint32_t simplex) CORTEX_REALTIME = 0;
    virtual void command(const OutsideCommand& command) CORTEX_REALTIME = 0;
    // To a command that this interface took from the Outbox: Running at most once, then the end.
    virtual void answer(const AgentCallAnswer& answer) CORTEX_REALTIME = 0;
    // Nothing comes any more from an agent or a tool that sent commands.
    virtual void senderLost(const Sender& sender) CORTEX_REALTIME = 0;
    virtual void event(Severity severity, EventKind kind, std::uint32_t simplex,
                       const EventText& text) CORTEX_REALTIME = 0;
};

// What write() hands to the transport: answers to commands that came through this interface, and
// commands to simplexes that it links. It answers each that it takes, at the latest with Unknown.
class Outbox {
public:
    virtual ~Outbox() = default;
    virtual bool nextAnswer(OutsideAnswer& answer) CORTEX_REALTIME = 0;  // false: no more
    virtual bool nextCall(AgentCall& call) CORTEX_REALTIME = 0;
};

class EventMemory;

// What an interface may use of the agent that it serves, on any thread but the loop's.
struct AgentAccess {
    std::shared_ptr<const Structure> structure;
    ImagePool* images = nullptr;
    EventLog* events = nullptr;
    EventMemory* memory = nullptr;  // of the past
    std::int64_t period = 0;        // ns
    std::uint32_t calls = 0;        // commands to other agents that may be on their way at once
    bool realTime = false;  // the loop's clock is that of the machine, so commands end by it too
    const StandstillNote* standstill = nullptr;  // of the loop
    const LoopPace* pace = nullptr;              // of the loop

    Image newestImage() const;  // empty if too many are held
    std::int64_t newestCycle() const;
};

// A transport. read() and write() run in the loop: they are wait-free and bounded. Everything
// else happens outside the loop.
class CommunicationInterface {
public:
    virtual ~CommunicationInterface() = default;
    virtual void announce(const AgentAccess& agent) = 0;  // start(): the structure is fixed
    virtual void read(Inbox& inbox) CORTEX_REALTIME = 0;
    virtual void write(std::int64_t cycle, Outbox& outbox) CORTEX_REALTIME = 0;
    virtual void close() = 0;  // stop(): after the last write()
};

}  // namespace cortex
