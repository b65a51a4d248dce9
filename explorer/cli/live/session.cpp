// SPDX-License-Identifier: Apache-2.0
#include "live/session.hpp"

#include "common/person_name.hpp"
#include "common/to_its_sender.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <utility>

namespace cortex::cli {
namespace {

constexpr std::size_t keptEvents = 1000;

}  // namespace

Session::Session(const comms::NetworkOptions& options, std::vector<std::string> named,
                 Milliseconds timeout)
    : domain_{options.domain},
      named_{std::move(named)},
      server_{options.discoveryServer},
      timeout_{timeout},
      mirror_{"cortex", options},
      leases_{mirror_} {
    actFor({});
}

comms::CommandAnswer Session::call(const std::string& path, const std::string& command,
                                   const comms::Mirror::Arguments& arguments, Milliseconds limit,
                                   const std::function<void()>& meanwhile) {
    const auto end = std::chrono::steady_clock::now() + limit;
    const std::uint64_t number = mirror_.send(path, command, arguments, limit);
    comms::CommandAnswer answer;
    for (;;) {
        const auto left = std::chrono::ceil<Milliseconds>(end - std::chrono::steady_clock::now());
        const Milliseconds wait = std::clamp(left, Milliseconds{0}, interruptSlice);
        if (mirror_.waitForAnswer(number, answer, wait)) {
            answer.why = common::toItsSender(answer.why);
            return answer;
        }
        if (meanwhile) meanwhile();
        if (left > interruptSlice && Interrupts::signal() == 0) continue;
        mirror_.abandon(number);
        throwIfInterrupted("no answer has come to '" + command + "': it may go on without us");
        answer.outcome = Outcome::Unknown;
        answer.why = "no answer within " + std::to_string(limit.count()) + " ms";
        return answer;
    }
}

void Session::introduce(const std::string& person) {
    mirror_.introduce(person);
    person_ = person;
    actFor({});
}

void Session::actFor(const std::string& person) {
    mirror_.actFor(common::nameInCommand(person.empty() ? common::personName(person_) : person));
}

void Session::view(std::vector<std::string> prefixes, std::uint32_t rate) {
    {
        const std::lock_guard lock{viewMutex_};
        wanted_ = std::move(prefixes);
        rate_ = rate;
        // What is viewed all the time comes anew, too: what it was before is older than the answer
        // to the command that a verb before this one has sent.
        if (!wanted_.empty()) {
            viewed_.clear();
            mirror_.view(viewed_);
        }
    }
    applyView();
}

void Session::acceptOffers() {
    {
        const std::lock_guard lock{viewMutex_};
        viewsAgents_ = true;
    }
    leases_.acceptOffers([this] { applyView(); });
}

void Session::applyView() {
    const std::lock_guard lock{viewMutex_};
    std::vector<std::string> prefixes = wanted_;
    if (viewsAgents_) {
        for (const comms::AgentStatus& each : mirror_.agents()) prefixes.push_back("/" + each.name);
    }
    if (prefixes == viewed_ && rate_ == viewedRate_) return;
    viewed_ = prefixes;
    viewedRate_ = rate_;
    mirror_.view(std::move(prefixes), rate_);
}

void Session::listen(Listener listener) {
    {
        const std::lock_guard lock{mutex_};
        for (const auto& [agent, events] : events_) {
            for (const comms::AgentEvent& each : events) {
                if (listener) listener(each);
            }
        }
        listener_ = std::move(listener);
        if (listens_ || !listener_) return;
        listens_ = true;
    }
    mirror_.onEvent([this](const comms::AgentEvent& event) { take(event); });
}

void Session::take(const comms::AgentEvent& event) {
    const std::lock_guard lock{mutex_};
    auto& events = events_[event.agent];
    events.push_back(event);
    if (events.size() > 2 * keptEvents) {
        events.erase(events.begin(), events.begin() + static_cast<long>(keptEvents));
    }
    if (listener_) listener_(event);
}

}  // namespace cortex::cli
