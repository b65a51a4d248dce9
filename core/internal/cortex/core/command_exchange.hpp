// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/program_interface.hpp"
#include "cortex/core/spsc_ring.hpp"
#include "cortex/core/transport.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// What a transport needs to carry commands from outside into a loop and their answers back.
namespace cortex {

// The commands of every simplex of a structure. Immutable; any thread may read.
class CommandTables {
public:
    explicit CommandTables(std::shared_ptr<const Structure> structure);
    CommandTables(const CommandTables&) = delete;
    CommandTables& operator=(const CommandTables&) = delete;

    const Structure& structure() const { return *structure_; }
    const CommandTable& of(std::uint32_t simplex) const { return *tables_[simplex]; }
    // Simplex, command and size of the record; throws Error with the nearest names.
    OutsideCommand find(std::string_view path, std::string_view command) const;

private:
    std::shared_ptr<const Structure> structure_;
    std::map<const TypeLayout*, CommandTable> byLayout_;
    std::vector<const CommandTable*> tables_;
};

// Until when a command may begin: `notAfter` and `until` of OutsideCommand.
struct Validity {
    std::int64_t notAfter = 0, until = 0;
};

// Commands from threads of this process into one agent's loop, and their answers back. Off the loop
// one thread at a time (the owner's mutex); read() and write() in the loop.
class CommandPipe {
public:
    CommandPipe(const AgentAccess& agent, std::uint32_t capacity);

    const Structure& structure() const { return *agent_.structure; }
    const CommandTables& tables() const { return tables_; }
    Validity validFor(std::int64_t cycles) const;  // from now on
    const CommandTable& table(std::uint32_t simplex) const { return tables_.of(simplex); }

    // False: full. `record` is copied.
    bool push(const OutsideCommand& command, const std::byte* record);
    // A command that is answered without the loop: later ones do not wait for its number. Of
    // `command` sender, targetEpoch, sequence and answeredBelow count. False: full.
    bool skip(const OutsideCommand& command);
    // The next answer, valid until popAnswer(); null: none.
    const OutsideAnswer* answer() { return answers_.front(); }
    void popAnswer() { answers_.pop(); }

    void read(Inbox& inbox) CORTEX_REALTIME;
    void write(Outbox& outbox) CORTEX_REALTIME;  // what finds no room waits for the next cycle

private:
    AgentAccess agent_;
    CommandTables tables_;
    SpscRing<OutsideCommand> commands_;
    SpscRing<OutsideAnswer> answers_;
    std::vector<std::byte> requests_, responses_;
};

// Commands of an agent's own tasks to simplexes of other agents: from its loop to the thread of a
// transport, and their answers back. There is always room for the answers. read() and write() in
// the loop; the rest on one thread of the transport.
class AgentCallPipe {
public:
    using Values = std::map<std::string, Value>;

    explicit AgentCallPipe(const AgentAccess& agent);

    // The next one, valid until pop(); null: none. By names, as another agent understands it.
    const AgentCall* front() { return calls_.front(); }
    void pop() { calls_.pop(); }
    const std::string& pathOf(const AgentCall& call) const;
    std::string commandOf(const AgentCall& call) const;
    Values argumentsOf(const AgentCall& call) const;
    // What the response has and our type does not is left out.
    void answer(const AgentCall& call, const CallResult& result);

    void read(Inbox& inbox) CORTEX_REALTIME;
    bool write(Outbox& outbox) CORTEX_REALTIME;  // whether any was sent

private:
    const CommandTable& table(const AgentCall& call) const { return tables_.of(call.simplex); }

    CommandTables tables_;
    SpscRing<AgentCall> calls_;
    SpscRing<AgentCallAnswer> answers_;
    std::vector<std::byte> requests_, responses_;
};

// A command that is numbered and encoded. Not open: its sender has too many on their way; it is
// answered MailboxFull already and not to be sent. Then its number is a ticket (see CommandClient).
struct PreparedCommand {
    OutsideCommand message;             // without `request`
    std::vector<std::uint64_t> record;  // message.size bytes
    bool open = true;

    const std::byte* request() const { return reinterpret_cast<const std::byte*>(record.data()); }
};

// One sender's side of its commands to one agent: sequence numbers, what is unanswered, and answers
// until they are fetched (the last thousand). Used under its owner's mutex. The agent waits for a
// number that it misses, so what is not sent has none, but a ticket from `firstTicket` on.
class CommandClient {
public:
    using Arguments = ProgramInterface::Arguments;

    static constexpr std::uint64_t firstTicket = std::uint64_t{1} << 63U;
    // Places of the window that only `shutdown` and `cancel` take: they always get through.
    static constexpr std::uint32_t keptForUrgent = 8;

    explicit CommandClient(Sender sender) : sender_{sender} {}

    const Sender& sender() const { return sender_; }
    // Throws Error as ProgramInterface::post(). Full pipes and windows answer MailboxFull.
    std::uint64_t post(CommandPipe& pipe, std::string_view path, std::string_view command,
                       const Arguments& arguments, Validity validity);
    bool hasRoom(std::string_view command) const;  // for one more, in the window
    // The first half of post(), for another transport; takeBack() where that cannot send it.
    PreparedCommand prepare(const CommandTables& tables, std::string_view path,
                            std::string_view command, const Arguments& arguments,
                            Validity validity);
    // The command that was prepared last is not sent: its number is free again, and the ticket
    // that this returns has the answer.
    std::uint64_t takeBack(const PreparedCommand& prepared, Outcome outcome, std::string why);

    void take(const OutsideAnswer& answer, const CommandPipe& pipe);
    void take(std::uint64_t sequence, Outcome outcome, Reason reason, std::string why,
              std::int64_t latencyCycles, std::map<std::string, Value> response);
    bool poll(std::uint64_t sequence, CallResult& result);
    bool running(std::uint64_t sequence) const;  // it was answered, but not for the last time
    void abandon(std::uint64_t sequence);        // its answer will not be fetched
    void loseAll(const std::string& why);        // no answer will come: Unknown

private:
    struct Asked {
        bool running = false;    // it was answered, but not for the last time
        bool abandoned = false;  // its answer will not be fetched
    };
    std::uint64_t answeredBelow() const;
    std::uint64_t refuse(Outcome outcome, std::string why);
    void finish(std::uint64_t sequence, CallResult result);
    void keep(std::uint64_t sequence, CallResult result);

    Sender sender_;
    std::uint64_t next_ = 1, nextTicket_ = firstTicket;
    std::map<std::uint64_t, Asked> unanswered_;
    std::map<std::uint64_t, CallResult> results_;
};

// Name cut to what fits, this host, and a start later than any other of this process.
Sender makeSender(std::string_view name);

}  // namespace cortex
