// SPDX-License-Identifier: Apache-2.0
#include "cortex/cs/simplex_cs.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/core/error.hpp"

#include "tasks/task_thread.hpp"

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

void SimplexCS::enterFault(std::int64_t code, std::string_view text) {
    if (pending_.fault) return;
    pending_.fault = true;
    thread_->faultCode = code;
    thread_->text = EventText{text};
}

void SimplexCS::setQuality(Quality quality, std::int64_t measuredAt) {
    if (thread_ == nullptr) return;  // not in a tick
    pending_.quality = true;
    quality_ = quality;
    thread_->measuredAt = measuredAt < 0 ? thread_->loop->nominalTime : measuredAt;
}

void SimplexCS::event(Severity severity, const EventText& text) {
    if (thread_ == nullptr) return;  // not in a tick
    runtime().post(*thread_->loop, severity, EventKind::Message, index(), text);
}

SimplexCS::LifeCycleSender SimplexCS::lifeCycle(const RelatedSimplex& target, bool manage) {
    const auto* active = dynamic_cast<const SimplexCS*>(&target.simplex());
    if (active == nullptr) {
        throw Error(path() + ": " + target.path() + " has no life cycle; it is a " +
                    target.type().name + ", not an active simplex of this agent");
    }
    LifeCycleSender sender;
    sender.runtime_ = &runtime();
    sender.target_ = active->index();
    sender.isDelayed_ = target.isDelayed();
    sender.state_ = InputSimplex{target}.data<std::int64_t>("state");
    if (manage) static_cast<SimplexCS&>(runtime().simplex(active->index())).manager_ = index();
    return sender;
}

AgentRuntime& SimplexCS::LifeCycleSender::bound() const {
    if (runtime_ == nullptr) throw UnboundHandle{"LifeCycleSender"};
    return *runtime_;
}

State SimplexCS::LifeCycleSender::state() const {
    return static_cast<State>(static_cast<std::int64_t>(state_));
}

void SimplexCS::LifeCycleSender::post(LifeCycle command) {
    bound().postLifeCycle(target_, command, isDelayed_);
}

}  // namespace cortex::cs
