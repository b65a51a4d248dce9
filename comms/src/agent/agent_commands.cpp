// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_commands.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/record.hpp"

#include "agent/agent_rivals.hpp"
#include "security/security_identity.hpp"
#include "wire/ids.hpp"
#include "wire/named_values.hpp"
#include "wire/presence_extras.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace cortex::comms {
namespace {

constexpr std::uint32_t onTheirWay = 256;  // commands
constexpr std::size_t mostSenders = 128;
constexpr std::size_t longestName = 128;  // of a name that is looked up; no path is longer

template <std::size_t Size>
bool put(const std::string& text, std::array<char, Size>& to) {
    if (text.size() >= Size || text.find('\0') != std::string::npos) return false;
    std::ranges::copy(text, to.begin());
    return true;
}

// Empty if the names cannot be those of a sender.
std::optional<Sender> senderOf(const Command& command) {
    Sender sender;
    sender.epoch = command.senderEpoch;
    const bool fits = put(command.sender, sender.name) && put(command.host, sender.host);
    if (!fits || command.sender.empty()) return {};
    return sender;
}

// What a command says of its origin, for its answer: who is behind it, and its correlation. Both
// are texts from outside.
std::vector<Extra> originOf(const Command& command) {
    constexpr std::size_t longest = 31;  // bytes
    std::vector<Extra> origin;
    for (const char* name : {onBehalfOf, correlation}) {
        const std::string text = textIn(command, name);
        const bool plain = std::ranges::none_of(
            text, [](unsigned char each) { return each < ' ' || each == 127U; });
        if (!text.empty() && text.size() <= longest && plain) origin.push_back({name, text});
    }
    return origin;
}

std::string prefixOf(const Value& value) {
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    std::string prefix = texts != nullptr && !texts->empty() ? texts->front() : "";
    while (prefix.ends_with('/')) prefix.pop_back();
    return prefix.empty() ? "/" : prefix;
}

}  // namespace

AgentCommands::AgentCommands(AgentSelf& self, std::function<void(const Answer&)> send,
                             SecurityIdentity* identity, const AgentRivals* rivals)
    : self_{self},
      send_{std::move(send)},
      identity_{identity},
      rivals_{rivals},
      pipe_{self.access, onTheirWay},
      lostSenders_{64} {}

bool AgentCommands::believable(const Command& command) {
    const char* wrong = nullptr;
    if (command.link != linkId(command.sender, command.target)) wrong = "with a wrong id";
    if (!senderOf(command) || !isStart(command.senderEpoch)) wrong = "of a sender that cannot be";
    if (command.sequenceNumber == 0 || command.answeredBelow > command.sequenceNumber) {
        wrong = "with a number that cannot be";
    }
    if (wrong != nullptr) self_.rejections.add(std::string{"a command "} + wrong);
    return wrong == nullptr;
}

void AgentCommands::take(const Command& command, std::int64_t now) {
    if (command.target != self_.name || !believable(command)) return;
    const Sender sender = *senderOf(command);
    if (!remember(sender, now)) {
        return refuse(command, {Outcome::Rejected, Reason::Window, "too many senders"});
    }
    if (command.targetEpoch != self_.epoch) {
        return refuse(command, {Outcome::Rejected, Reason::Restarted,
                                "it is meant for another start of this agent"});
    }
    HeardSender& from = senders_[command.sender];
    OutsideCommand message;
    std::vector<std::uint64_t> record;
    Refusal refusal{};
    const bool known = encode(command, message, record, refusal);
    message.sender = sender;
    message.targetEpoch = command.targetEpoch;
    message.sequence = command.sequenceNumber;
    message.answeredBelow = command.answeredBelow;
    message.notAfter = command.notAfter;
    message.until = static_cast<std::int64_t>(numberIn(command, validUntil));
    const bool inLoop = isInLoop(command, from);
    if (!known || !permitted(command, message, record, refusal) ||
        (!inLoop && !isOurs(message, refusal))) {
        if (inLoop) return;
        if (isProven(command)) skip(message, from);
        return refuse(command, refusal);
    }
    keepOrigin(command, message, from);
    pass(command, message, record, from);
}

bool AgentCommands::isInLoop(const Command& command, const HeardSender& from) {
    const std::uint64_t number = command.sequenceNumber;
    return from.sender.epoch == command.senderEpoch &&
           (number < from.answeredBelow || from.passed.contains(number));
}

bool AgentCommands::isOurs(const OutsideCommand& message, Refusal& refusal) const {
    if (rivals_ == nullptr) return true;
    refusal = {Outcome::Rejected, Reason::UnknownCommand, rivals_->refusal(message.simplex)};
    return refusal.why.empty();
}

void AgentCommands::keepOrigin(const Command& command, OutsideCommand& message, HeardSender& from) {
    std::vector<Extra> origin = originOf(command);
    for (const Extra& each : origin) {
        if (each.name == onBehalfOf) put(each.value, message.onBehalfOf);
    }
    auto& origins = from.origins;
    origins.erase(origins.begin(), origins.lower_bound(command.answeredBelow));
    if (!origin.empty() && origins.size() < 2 * senderWindow) {
        origins[message.sequence] = std::move(origin);
    }
}

// The loop takes no number beyond the window, so none of those is kept.
void AgentCommands::pass(const Command& command, const OutsideCommand& message,
                         const std::vector<std::uint64_t>& record, HeardSender& from) {
    const bool accepts = !from.turnedAway.contains(message.sequence) && passSkips(from) &&
                         pipe_.push(message, reinterpret_cast<const std::byte*>(record.data()));
    if (!accepts) return turnAway(command, message, from);
    if (from.sender.epoch != message.sender.epoch) return;
    from.answeredBelow = std::max(from.answeredBelow, message.answeredBelow);
    from.passed.erase(from.passed.begin(), from.passed.lower_bound(from.answeredBelow));
    if (message.sequence - from.answeredBelow < senderWindow) from.passed.insert(message.sequence);
}

// With security only who proves to be the sender may let one of its numbers count as come.
bool AgentCommands::isProven(const Command& command) {
    std::string why;
    return identity_ == nullptr || identity_->rightsOf(command, why) != nullptr;
}

// The loop does not wait for the number of a command that is answered here, and keeps it refused.
// Without room in the pipe it is told later.
void AgentCommands::skip(const OutsideCommand& message, HeardSender& from) {
    if (from.skips.size() < 2 * senderWindow) from.skips[message.sequence] = message;
    passSkips(from);
}

bool AgentCommands::passSkips(HeardSender& from) {
    while (!from.skips.empty() && pipe_.skip(from.skips.begin()->second)) {
        from.skips.erase(from.skips.begin());
    }
    return from.skips.empty();
}

// The loop accepts no more commands. If it has this one already, the answer comes from the loop. A
// command that was refused once stays refused: its sender may have read the answer. Where it is not
// known what came before of a start there is no answer, so the sender tries again.
void AgentCommands::turnAway(const Command& command, const OutsideCommand& message,
                             HeardSender& from) {
    self_.rejections.add("a command of " + command.sender + ": too many are on their way");
    if (from.sender.epoch != message.sender.epoch || !from.isWholeStart) return;
    auto& known = from.turnedAway;
    known.erase(known.begin(), known.lower_bound(command.answeredBelow));
    const bool repeated = known.contains(command.sequenceNumber);
    if (!repeated) {
        if (isInLoop(command, from) || known.size() >= 2 * senderWindow) return;
        known.insert(command.sequenceNumber);
        skip(message, from);
    }
    refuse(command, {Outcome::MailboxFull, Reason::None, "too many commands are on their way"});
}

// Looks up simplex, command and arguments by their names. What does not fit is refused in the words
// of core.
bool AgentCommands::encode(const Command& command, OutsideCommand& message,
                           std::vector<std::uint64_t>& record, Refusal& refusal) const {
    refusal = {Outcome::Rejected, Reason::UnknownCommand, {}};
    try {
        if (std::max(command.path.size(), command.command.size()) > longestName) {
            throw Error("no path and no command has a name as long as that");
        }
        message = pipe_.tables().find(command.path, command.command);
        if (self_.structure().simplexes[message.simplex].remote) {
            throw Error(command.path + " belongs to another agent");
        }
        refusal.reason = Reason::Range;
        const auto arguments = valuesOf(command.arguments);
        if (!arguments) throw Error("its arguments are malformed, or one is given twice");
        record.resize(message.size / 8U + 1U);
        encodeRecord(pipe_.table(message.simplex), message.command, *arguments,
                     reinterpret_cast<std::byte*>(record.data()));
        return true;
    } catch (const Error& error) {
        refusal.why = error.what();
        return false;
    }
}

// With security, the signed list of the sender must cover the path. A command to the agent itself
// with a prefix concerns everything at and below that prefix.
bool AgentCommands::permitted(const Command& command, const OutsideCommand& message,
                              const std::vector<std::uint64_t>& record, Refusal& refusal) {
    if (identity_ == nullptr) return true;
    std::string path = command.path;
    if (message.simplex == self_.simplex && command.command != "set") {
        const auto arguments = argumentsOf(pipe_.table(message.simplex), message.command,
                                           reinterpret_cast<const std::byte*>(record.data()));
        if (const auto prefix = arguments.find("prefix"); prefix != arguments.end()) {
            path = prefixOf(prefix->second);
        }
    }
    std::string why;
    const auto rights = identity_->rightsOf(command, why);
    if (rights && mayCommand(*rights, path, why)) return true;
    refusal = {Outcome::Rejected, Reason::Authority, why};
    const bool repeated =
        command.link == reportedLink_ && command.sequenceNumber == reportedNumber_;
    reportedLink_ = command.link;
    reportedNumber_ = command.sequenceNumber;
    if (repeated) return false;
    const std::string what =
        command.command + " from " + command.sender + "@" + command.host + " refused: " + why;
    self_.rejections.add(what);
    self_.event(Severity::Warning, message.simplex, what);
    return false;
}

void AgentCommands::refuse(const Command& command, const Refusal& refusal) {
    Answer answer;
    answer.link = command.link;
    answer.agent = self_.name;
    answer.epoch = self_.epoch;
    answer.sender = command.sender;
    answer.senderEpoch = command.senderEpoch;
    answer.sequenceNumber = command.sequenceNumber;
    answer.outcome = name(refusal.outcome);
    answer.reason = name(refusal.reason);
    answer.why = refusal.why;
    answer.extras = originOf(command);
    send_(answer);
}

bool AgentCommands::remember(const Sender& sender, std::int64_t now) {
    const std::string name{sender.nameText()};
    const auto known = senders_.find(name);
    if (known == senders_.end()) {
        if (senders_.size() >= mostSenders && !forgetOneLost()) return false;
        senders_[name] = {.sender = sender, .lastHeard = now};
        return true;
    }
    HeardSender& before = known->second;
    const bool isLater = before.sender.epoch < sender.epoch;
    if (before.sender.epoch == sender.epoch) {
        before.lastHeard = now;
        before.isLost = false;
    } else if (isLater || before.isLost) {
        // The loop itself drops an earlier start when a later one commands.
        before = {.sender = sender, .lastHeard = now, .isWholeStart = isLater};
    }
    return true;
}

// The one that was lost first: where there is room all are kept, as they may be heard again.
bool AgentCommands::forgetOneLost() {
    auto first = senders_.end();
    for (auto each = senders_.begin(); each != senders_.end(); ++each) {
        if (!each->second.isLost) continue;
        if (first == senders_.end() || each->second.lastHeard < first->second.lastHeard) {
            first = each;
        }
    }
    if (first == senders_.end()) return false;
    senders_.erase(first);
    return true;
}

void AgentCommands::heard(const Presence& presence, std::int64_t now) {
    const auto known = senders_.find(presence.name);
    if (known == senders_.end() || known->second.isLost) return;
    if (known->second.sender.epoch != presence.epoch) return;
    known->second.lastHeard = now;
    known->second.patience = patienceWith(presence);
}

void AgentCommands::lost(const std::string& sender, std::int64_t epoch) {
    const auto known = senders_.find(sender);
    if (known != senders_.end() && known->second.sender.epoch == epoch) {
        known->second.lastHeard = monotonicNow() - 2 * known->second.patience;
    }
}

bool AgentCommands::reportLost(const Sender& sender) {
    Sender* place = lostSenders_.free();
    if (place == nullptr) return false;  // the loop stands still; the next step tries again
    *place = sender;
    lostSenders_.push();
    return true;
}

void AgentCommands::step(std::int64_t now) {
    for (; const OutsideAnswer* answer = pipe_.answer(); pipe_.popAnswer()) {
        send_(answerFor(*answer));
    }
    for (auto& [name, each] : senders_) {
        passSkips(each);
        if (each.isLost || now - each.lastHeard <= each.patience) continue;
        each.isLost = reportLost(each.sender);
    }
}

Answer AgentCommands::answerFor(const OutsideAnswer& answer) const {
    Answer message;
    message.sender = answer.sender.nameText();
    message.link = linkId(message.sender, self_.name);
    message.agent = self_.name;
    message.epoch = self_.epoch;
    message.senderEpoch = answer.sender.epoch;
    message.sequenceNumber = answer.sequence;
    message.outcome = name(answer.outcome);
    message.reason = name(answer.reason);
    message.why = answer.why.view();
    message.latencyCycles = answer.latencyCycles;
    message.latency = answer.latency;
    if (answer.size > 0) {
        const auto& entry = pipe_.table(answer.simplex).entries[answer.command];
        message.response = namedValues(decodeRecord(entry.response, answer.response));
    }
    const auto known = senders_.find(message.sender);
    if (known != senders_.end() && known->second.sender.epoch == message.senderEpoch) {
        const auto origin = known->second.origins.find(message.sequenceNumber);
        if (origin != known->second.origins.end()) message.extras = origin->second;
    }
    return message;
}

void AgentCommands::read(Inbox& inbox) {
    for (std::size_t i = 0; i < lostSenders_.size(); ++i) {
        const Sender* sender = lostSenders_.front();
        if (sender == nullptr) break;
        inbox.senderLost(*sender);
        lostSenders_.pop();
    }
    pipe_.read(inbox);
}

bool AgentCommands::write(Outbox& outbox) {
    pipe_.write(outbox);
    return pipe_.answer() != nullptr;
}

}  // namespace cortex::comms
