// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/clock.hpp"
#include "cortex/core/event_count.hpp"

#include "agent/agent_answers.hpp"
#include "agent/agent_call_sender.hpp"
#include "agent/agent_commands.hpp"
#include "agent/agent_events.hpp"
#include "agent/agent_links.hpp"
#include "agent/agent_model.hpp"
#include "agent/agent_network.hpp"
#include "agent/agent_past.hpp"
#include "agent/agent_peers.hpp"
#include "agent/agent_received.hpp"
#include "agent/agent_rivals.hpp"
#include "agent/agent_self.hpp"
#include "agent/agent_streams.hpp"
#include "agent/agent_summary.hpp"
#include "agent/agent_value_watch.hpp"
#include "dds/participant.hpp"
#include "peers/rejoin.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cortex::comms {

// One agent on the network: its participant and its communication thread, the only thread that
// writes to DDS. announce() runs the constructor, which joins the network. The loop calls read()
// and write().
class AgentThread {
public:
    AgentThread(const AgentAccess& agent, const NetworkOptions& options);
    ~AgentThread();  // sends what is left and leaves the network

    void read(Inbox& inbox) CORTEX_REALTIME;
    void write(Outbox& outbox) CORTEX_REALTIME;

    std::uint64_t rejected() const {
        const std::lock_guard lock{joining_};
        return self_.rejections.count() + participant_.malformed() + participant_.refused();
    }
    std::map<std::string, std::uint64_t> rejections() const;  // by reason
    std::uint64_t lost() const { return links_.lost(); }
    std::string lastRejection() const { return self_.rejections.last(); }
    // Whether another start of the name was there first. Any thread.
    bool isSecond() const { return standing_.load() == Standing::Second; }

private:
    enum class Standing { Unknown, First, Second };

    template <class Message>
    std::unique_ptr<Reader<Message>> receive(const Topic& topic);
    void makeEndpoints();
    void joinAnew();
    void awaitStanding(const NetworkOptions& options);
    void meet(std::int64_t now);
    void run();
    void wait(std::chrono::nanoseconds limit);
    void awaitWrite(std::int64_t time);
    template <class Function>
    void guarded(Function function);
    void step();
    void takeMessages(std::int64_t now);
    void reportRefusals();
    void changed();
    void listenToOwners();
    void feed(std::int64_t now);
    void sendInterest();
    void sendEvents();
    Presence presence(const char* state) const;
    void addTimes(Presence& presence) const;
    void addRefusals(Presence& presence) const;
    void sendPresence(std::int64_t now);
    void beSilent(bool silent);
    void sendAnswer(const Answer& answer);
    void leave();

    AgentSelf self_;
    AgentNetwork network_;
    Rejoin rejoin_;
    AgentModel model_;
    Participant participant_;
    EventCount signals_;  // wakes the communication thread
    ReceivedQueue received_;
    std::unique_ptr<Writer<Presence>> presenceOut_;
    std::unique_ptr<Writer<Model>> modelOut_;
    std::unique_ptr<Writer<EventMessage>> eventOut_;
    AgentEvents events_;
    AgentAnswers answers_;
    AgentRivals rivals_;
    AgentCommands commands_;
    AgentLinks links_;
    std::unique_ptr<Writer<Interest>> interestOut_;  // null: this agent links nothing
    AgentStreams streams_;
    AgentSummary summary_;
    AgentPast past_;
    AgentValueWatch values_;
    AgentCallSender calls_;
    AgentPeers peers_;
    std::unique_ptr<Reader<Presence>> presenceIn_;
    // Null: this agent links nothing, and nobody may have a path of it.
    std::unique_ptr<Reader<Model>> modelIn_;
    std::unique_ptr<Reader<Interest>> interestIn_;
    std::map<std::string, std::unique_ptr<Reader<Block>>> linksIn_;  // by owner
    std::unique_ptr<Reader<Command>> commandIn_;
    std::unique_ptr<Reader<Answer>> answerIn_;  // null: this agent commands no other

    // These belong to the communication thread.
    ReceivedMessages messages_;
    std::vector<EventMessage> eventsToSend_;
    std::uint64_t lastEvent_ = 0;  // number of the last event that was written
    std::int64_t newestCycle_ = 0, newCycleAt_ = self_.began;  // of the loop
    std::int64_t presenceDue_ = 0;
    std::uint32_t seen_ = 0;  // value of signals_
    bool silent_ = false;
    std::uint32_t found_ = 0;   // participants on the network
    std::int64_t foundAt_ = 0;  // when the last of them was found

    std::atomic<Standing> standing_{Standing::Unknown};

    // Held while the participant is replaced, and by other threads that ask it something.
    mutable std::mutex joining_;
    std::atomic<bool> everyCycle_{false};  // somebody reads every cycle
    std::atomic<std::int64_t> next_{0};    // when the loop is expected to write for them
    std::atomic<bool> stopping_{false};
    std::thread thread_;
};

}  // namespace cortex::comms
