// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_call_sender.hpp"

#include "cortex/core/control_commands.hpp"
#include "cortex/core/error.hpp"

#include "security/security_identity.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::chrono::seconds budget{1};

Sender senderOf(const AgentSelf& self) {
    Sender sender;
    std::ranges::copy(self.name.substr(0, sender.name.size() - 1), sender.name.begin());
    std::ranges::copy(self.host.substr(0, sender.host.size() - 1), sender.host.begin());
    sender.epoch = self.epoch;
    return sender;
}

// Null: it is not heard, or another start of it is.
const Peer* heardAs(const Peers& peers, const std::string& agent, std::int64_t epoch) {
    const auto found = peers.find(agent);
    if (found == peers.end()) return nullptr;
    const Peer& peer = found->second;
    return peer.heard && peer.current && peer.epoch() == epoch ? &peer : nullptr;
}

CallResult withoutAnswer(Outcome outcome, Reason reason, std::string why) {
    CallResult result;
    result.outcome = outcome;
    result.reason = reason;
    result.why = std::move(why);
    return result;
}

}  // namespace

AgentCallSender::AgentCallSender(AgentSelf& self, const AgentLinks& links, Participant& participant)
    : self_{self},
      links_{links},
      participant_{participant},
      pipe_{self.access},
      sent_{senderOf(self)} {
    join();
}

void AgentCallSender::join() {
    if (any()) out_ = participant_.writer<Command>(topics::command);
}

void AgentCallSender::step(const Peers& peers, bool silent) {
    if (!any()) return;
    const Moment now = std::chrono::steady_clock::now();
    sendHeld(peers, silent, now);
    for (; const AgentCall* call = pipe_.front(); pipe_.pop()) {
        send(*call, peers, silent, now + budget);
    }
    loseThoseOf(peers);
    if (!silent) {
        sent_.tick(std::chrono::steady_clock::now(), [this](const Command& command) {
            if (participant_.identity() == nullptr) return out_->write(command);
            Command proven = command;
            participant_.identity()->sign(proven);
            return out_->write(proven);
        });
    }
    passAnswers();
}

void AgentCallSender::sendHeld(const Peers& peers, bool silent, Moment now) {
    for (const Held& each : std::exchange(held_, {})) {
        if (now < each.end) {
            send(each.call, peers, silent, each.end);
        } else {
            pipe_.answer(each.call, withoutAnswer(Outcome::MailboxFull, Reason::None,
                                                  "too many commands are on their way"));
        }
    }
}

// What is not sent surely does not run. `end`: until when it may be.
void AgentCallSender::send(const AgentCall& call, const Peers& peers, bool silent, Moment end) {
    const auto owner = links_.ownerOf(call.simplex);
    const Peer* peer =
        owner.structure != nullptr && !silent ? heardAs(peers, owner.agent, owner.epoch) : nullptr;
    if (peer == nullptr) {
        return pipe_.answer(call,
                            withoutAnswer(Outcome::Expired, Reason::None,
                                          silent ? "this agent is silent: it was not sent"
                                                 : "its agent is not heard: it was not sent"));
    }
    const std::string command = pipe_.commandOf(call);
    if (isUrgentCommand(command) && !sent_.hasRoom(owner.agent, command)) {
        Held& held =
            held_.emplace_back(call, std::vector(call.request, call.request + call.size), end);
        held.call.request = held.request.data();
        return;
    }
    try {
        const Presence& presence = *peer->model().presence();
        const Moment heard{std::chrono::nanoseconds{peer->lastHeard}};
        const CommandTarget target{
            .model = peer->model(),
            .tables = tablesOf(owner),
            .cycle = presence.cycle,
            .heard = heard,
            .clock = timeIn(presence, clockOfAgent),
            .clockHeard = heard,
            .lost = false,
        };
        const std::uint64_t number =
            sent_.send(target, pipe_.pathOf(call), command, pipe_.argumentsOf(call), budget,
                       std::chrono::steady_clock::now());
        open_.push_back({call, number, owner.agent, owner.epoch});
    } catch (const Error& error) {  // its type is another than ours
        pipe_.answer(call, withoutAnswer(Outcome::Rejected, Reason::UnknownCommand, error.what()));
    }
}

void AgentCallSender::loseThoseOf(const Peers& peers) {
    for (const Open& each : open_) {
        if (heardAs(peers, each.agent, each.epoch) != nullptr) continue;
        sent_.lose(each.agent, "agent " + each.agent + " is not heard any more: it may have run");
    }
}

void AgentCallSender::passAnswers() {
    std::erase_if(open_, [this](Open& each) {
        CallResult result;
        if (sent_.poll(each.number, result)) {
            pipe_.answer(each.call, result);
            return true;
        }
        if (sent_.running(each.number) && !std::exchange(each.running, true)) {
            pipe_.answer(each.call, withoutAnswer(Outcome::Running, Reason::None, {}));
        }
        return false;
    });
}

const CommandTables& AgentCallSender::tablesOf(const AgentLinks::OwnerOf& owner) {
    Tables& known = tables_[owner.agent];
    if (known.structure != owner.structure) {
        known.tables = std::make_unique<CommandTables>(owner.structure);
        known.structure = owner.structure;
    }
    return *known.tables;
}

}  // namespace cortex::comms
