// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/simplex_cs.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "tasks/task_thread.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <string>

namespace cortex::cs {

void SimplexCS::fault(std::int64_t code, std::string_view text) {
    if (thread_ == nullptr) throw Error(path() + ": fault() is for hooks; to refuse, throw");
    if (code <= 0) {
        throw Error("fault code " + std::to_string(code) +
                    " is not above 0, as a simplex's own are: " + std::string{text});
    }
    enterFault(code, text);
}

void SimplexCS::enterFault(std::int64_t code, std::string_view text, std::string_view brief) {
    if (pending_.fault) return;
    pending_.fault = true;
    thread_->faultCode = code;
    thread_->text = EventText{text};
    thread_->brief = EventText{brief.empty() ? text : brief};
}

void SimplexCS::setQuality(Quality quality, std::int64_t measuredAt) {
    if (thread_ == nullptr) return;  // not in a tick
    pending_.quality = true;
    quality_ = quality;
    thread_->measuredAt = measuredAt == thisCycle ? thread_->loop->nominalTime : measuredAt;
}

void SimplexCS::event(Severity severity, const EventText& text) {
    if (thread_ == nullptr) return;  // not in a tick
    runtime().post(*thread_->loop, severity, EventKind::Message, index(), text);
}

namespace {

void refuseUnderClock(const Simplex& simplex, bool underClock) {
    if (!underClock) return;
    throw Error(simplex.path() + ": a clock runs its loop, so nobody knows when it is between " +
                "two cycles; state is saved and restored under a manual trigger");
}

void requireFit(const Simplex& simplex, const Archive& archive, const char* otherwise) {
    if (!archive.problem()) return;
    throw Error(simplex.path() + ": " + std::string{archive.problem()->view()} + "; " + otherwise);
}

}  // namespace

std::vector<std::byte> SimplexCS::savedState() {
    refuseUnderClock(*this, runtime().writersRefused());
    Archive measured;
    keep(measured);
    std::vector<std::byte> bytes(measured.size());
    Archive archive{bytes};
    keep(archive);
    requireFit(*this, archive, "keep() hands over more than before");
    return bytes;
}

void SimplexCS::restoreState(std::span<const std::byte> saved) {
    refuseUnderClock(*this, runtime().writersRefused());
    Archive check{saved, Archive::Purpose::Check};
    keep(check);
    check.finish();
    requireFit(*this, check, "nothing was restored");
    Archive archive{saved, Archive::Purpose::Restore};
    keep(archive);
}

// Handles on the three commands of a simplex of another agent.
struct SimplexCS::LifeCycleSender::Remote {
    CommandSender& of(LifeCycle command) {
        return senders[static_cast<std::size_t>(command) - std::size_t{1}];
    }
    std::array<CommandSender, 3> senders;  // in the order of LifeCycle, without None
    const CommandSender* last = nullptr;
};

SimplexCS::LifeCycleSender SimplexCS::lifeCycle(const RelatedSimplex& target, bool manage) {
    LifeCycleSender sender;
    sender.runtime_ = &runtime();
    if (target.isRemote() && target.type().isA("Active")) {
        if (manage) {
            throw Error(path() + ": " + target.path() +
                        " belongs to another agent, whose group commands do not ask this one: "
                        "leave out `manage`");
        }
        const InputSimplex input{target};
        sender.remote_ = std::make_shared<LifeCycleSender::Remote>();
        sender.remote_->senders = {input.command("startup", 1), input.command("shutdown", 1),
                                   input.command("clearFaults", 1)};
        sender.state_ = input.data<std::int64_t>("state");
        return sender;
    }
    const auto* active =
        target.isRemote() ? nullptr : dynamic_cast<const SimplexCS*>(&target.simplex());
    if (active == nullptr) {
        throw Error(path() + ": " + target.path() + " has no life cycle; it is a " +
                    target.type().name + ", not an active simplex");
    }
    sender.target_ = active->index();
    sender.isDelayed_ = target.isDelayed();
    sender.state_ = InputSimplex{target}.data<std::int64_t>("state");
    if (manage) static_cast<SimplexCS&>(runtime().simplex(active->index())).manager_ = index();
    return sender;
}

AgentRuntime& SimplexCS::LifeCycleSender::bound() const {
    if (runtime_ == nullptr) throw UnboundHandle{"LifeCycleSender", this};
    return *runtime_;
}

State SimplexCS::LifeCycleSender::state() const {
    bound();
    return static_cast<State>(static_cast<std::int64_t>(state_));
}

const AnswerHead& SimplexCS::LifeCycleSender::answer() const {
    static const AnswerHead none;
    bound();
    return remote_ != nullptr && remote_->last != nullptr ? remote_->last->answer() : none;
}

void SimplexCS::LifeCycleSender::post(LifeCycle command) {
    AgentRuntime& agent = bound();
    if (remote_ == nullptr) return agent.postLifeCycle(target_, command, isDelayed_);
    CommandSender& sender = remote_->of(command);
    if (sender.sent() != sender.answered()) return;
    sender.send();
    remote_->last = &sender;
}

}  // namespace cortex::cs
