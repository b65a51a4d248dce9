// SPDX-License-Identifier: Apache-2.0
#include "session/session.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/realtime.hpp"

#include "common/person_name.hpp"
#include "session/utc_now.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace cortex::gui {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto framePeriod = 33ms;
constexpr std::size_t mostEvents = 100'000;
constexpr auto overdue = 500ms;  // the session's thread is held up
constexpr auto deaf = 1s;        // a window that does not answer for so long must not hold a plant

bool sameStructures(const Frame& a, const Frame& b) {
    return a.contested == b.contested &&
           std::ranges::equal(a.agents, b.agents, [](const AgentFrame& x, const AgentFrame& y) {
               return x.structure == y.structure && x.status.name == y.status.name &&
                      x.lost() == y.lost();
           });
}

AgentFrame agentFrame(const comms::Mirror& mirror, const comms::AgentStatus& status) {
    AgentFrame result;
    result.status = status;
    result.structure = mirror.structure(status.name);
    if (!result.structure) return result;
    auto image = std::make_shared<comms::AgentImage>(mirror.image(status.name));
    if (!*image || (*image)->structure().epoch != result.structure->epoch) return result;
    result.image = std::move(image);
    const auto ages = mirror.ages(status.name);
    result.ages.reserve(result.structure->simplexes.size());
    for (std::uint32_t i = 0; i < result.structure->simplexes.size(); ++i) {
        const bool known = result.image->came(i) && i < ages.size() && ages[i];
        result.ages.push_back(known ? static_cast<float>(*ages[i]) : -1.0F);
    }
    return result;
}

// The same moment, so much later.
std::shared_ptr<const Frame> aged(const Frame& frame, double seconds) {
    auto result = std::make_shared<Frame>(frame);
    result->seconds += seconds;
    for (AgentFrame& agent : result->agents) agent = agent.later(seconds);
    return result;
}

}  // namespace

Session::Session(comms::NetworkOptions options, const std::string& person)
    : options_{std::move(options)},
      person_{common::personName(person)},
      begin_{Clock::now()},
      published_{begin_} {
    auto first = std::make_shared<Frame>();
    first->domain = options_.domain;
    frame_ = std::move(first);
    thread_ = std::thread{[this] { run(); }};
}

Session::~Session() {
    {
        const std::lock_guard lock{mutex_};
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

// A lock for the copy of a pointer: libstdc++ 12 has a data race in std::atomic<std::shared_ptr>.
std::shared_ptr<const Frame> Session::frame() const {
    std::unique_lock lock{mutex_};
    auto newest = frame_;
    const auto since = Clock::now() - published_;
    lock.unlock();
    if (since < overdue) return newest;
    return aged(*newest, std::chrono::duration<double>(since).count());
}

void Session::view(std::vector<std::string> prefixes, std::vector<comms::Viewed> others) {
    const std::lock_guard lock{mutex_};
    wanted_ = std::move(prefixes);
    others_ = std::move(others);
}

void Session::setRate(std::uint32_t rate) {
    const std::lock_guard lock{mutex_};
    rate_ = rate;
}

std::vector<comms::AgentEvent> Session::takeEvents() {
    const std::lock_guard lock{mutex_};
    return std::exchange(events_, {});
}

std::uint64_t Session::send(std::string path, std::string command,
                            comms::Mirror::Arguments arguments, std::chrono::milliseconds limit,
                            std::chrono::milliseconds budget) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock{mutex_};
        number = ++lastNumber_;
        CommandRequest request{number, std::move(path), std::move(command), std::move(arguments),
                               limit,  budget};
        requests_.push_back(std::move(request));
    }
    changed_.notify_all();
    return number;
}

std::vector<CommandOutcome> Session::takeOutcomes() {
    const std::lock_guard lock{mutex_};
    return std::exchange(outcomes_, {});
}

std::uint64_t Session::hold(HeldCommand command) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock{mutex_};
        number = ++lastNumber_;
        holdChanges_.emplace_back(
            [number, command = std::move(command)](Holds& holds) { holds.begin(number, command); });
    }
    changed_.notify_all();
    return number;
}

void Session::changeHold(std::uint64_t number, comms::Mirror::Arguments arguments) {
    const std::lock_guard lock{mutex_};
    holdChanges_.emplace_back([number, arguments = std::move(arguments)](Holds& holds) {
        holds.change(number, arguments);
    });
}

void Session::endHold(std::uint64_t number) {
    {
        const std::lock_guard lock{mutex_};
        holdChanges_.emplace_back([this, number](Holds& holds) { holds.end(number, *frame_); });
    }
    changed_.notify_all();
}

std::vector<HoldEnd> Session::takeHoldEnds() {
    const std::lock_guard lock{mutex_};
    return std::exchange(holdEnds_, {});
}

void Session::dismiss(std::string agent) {
    const std::lock_guard lock{mutex_};
    dismissed_.push_back(std::move(agent));
}

void Session::change(ControlChange control) {
    {
        const std::lock_guard lock{mutex_};
        controlChanges_.push_back(std::move(control));
    }
    changed_.notify_all();
}

void Session::takeControl(std::string prefix) {
    change([prefix = std::move(prefix)](LeaseKeeper& leases, const Frame& frame) {
        leases.take(prefix, frame);
    });
}

void Session::releaseControl() {
    change([](LeaseKeeper& leases, const Frame&) { leases.release(); });
}

void Session::handOver(std::string to) {
    change([to = std::move(to)](LeaseKeeper& leases, const Frame&) { leases.handOver(to); });
}

void Session::askForControl(std::string prefix) {
    change([prefix = std::move(prefix)](LeaseKeeper& leases, const Frame&) { leases.ask(prefix); });
}

void Session::withdrawAsk() {
    change([](LeaseKeeper& leases, const Frame&) { leases.withdraw(); });
}

void Session::grant(comms::LeaseClient::Asked asked) {
    change([asked = std::move(asked)](LeaseKeeper& leases, const Frame&) { leases.grant(asked); });
}

void Session::refuse(comms::LeaseClient::Asked asked) {
    change([asked = std::move(asked)](LeaseKeeper& leases, const Frame&) { leases.refuse(asked); });
}

void Session::isAlive() { alive_ = Clock::now().time_since_epoch().count(); }

void Session::joinAgain() {
    {
        const std::lock_guard lock{mutex_};
        again_ = true;
    }
    changed_.notify_all();
}

void Session::run() {
    join();
    do {
        bool again = false;
        std::vector<std::string> wanted;
        std::vector<comms::Viewed> others;
        std::uint32_t rate = 0;
        {
            const std::lock_guard lock{mutex_};
            again = std::exchange(again_, false);
            wanted = wanted_;
            others = others_;
            rate = rate_;
        }
        if (again && !mirror_) join();
        if (mirror_) applyView(std::move(wanted), std::move(others), rate);
        keepCommands();
        keepControl();
        keepHolds();
        keepPast();
        publish();
    } while (pause());
    leave();
}

void Session::leave() {
    past_.reset();
    sent_.reset();
    holds_.reset();
    leases_.reset();
    mirror_.reset();
}

// The agents' own simplexes are always viewed: they say who holds control of what.
void Session::applyView(std::vector<std::string> wanted, std::vector<comms::Viewed> views,
                        std::uint32_t rate) {
    for (const AgentFrame& each : frame_->agents) wanted.push_back("/" + each.status.name);
    if (auto recorded = recorder_.viewed(); !recorded.empty()) {
        views.push_back({std::move(recorded), 0});
    }
    views.push_back({std::move(wanted), rate});
    const bool same = std::ranges::equal(applied_, views, [](const auto& one, const auto& other) {
        return one.rate == other.rate && one.prefixes == other.prefixes;
    });
    if (same) return;
    applied_ = std::move(views);
    appliedRate_ = rate;
    mirror_->view(applied_);
}

void Session::join() {
    begin_ = Clock::now();
    problem_.clear();
    publish();
    try {
        comms::NetworkOptions options = options_;
        if (comms::onLoopback(options.domain) != comms::OnLoopback::None) {
            comms::alsoOnLoopback(options);
        }
        comms::onNamedInterfaces(options);
        mirror_ = std::make_unique<comms::Mirror>("cortex-explorer", options);
        mirror_->introduce(person_);
        mirror_->actFor(common::nameInCommand(person_));
        leases_ = std::make_unique<LeaseKeeper>(*mirror_, person_, options.security);
        holds_ = std::make_unique<Holds>(*mirror_);
        sent_ = std::make_unique<SentCommands>(*mirror_);
        past_ = std::make_unique<PastAsks>(*mirror_);
        applied_.clear();
        mirror_->prepareCommands();  // the first one may be Stop
        mirror_->onImage([this](const std::string& agent, const comms::AgentImage& image) {
            recorder_.hear(agent, image, utcNow());
        });
        mirror_->onEvent([this](const comms::AgentEvent& event) {
            const std::lock_guard lock{mutex_};
            if (events_.size() < mostEvents) events_.push_back(event);
        });
    } catch (const std::exception& error) {
        leave();
        problem_ = error.what();
    }
}

void Session::keepCommands() {
    std::vector<CommandRequest> requests;
    {
        const std::lock_guard lock{mutex_};
        requests = std::exchange(requests_, {});
    }
    const auto last = frame_;
    std::vector<CommandOutcome> outcomes;
    if (sent_) {
        outcomes = sent_->send(std::move(requests), *last);
        std::ranges::move(sent_->step(*last), std::back_inserter(outcomes));
    } else {
        for (const CommandRequest& each : requests)
            outcomes.push_back(notSent(each, "no domain is joined"));
    }
    const std::lock_guard lock{mutex_};
    std::ranges::move(outcomes, std::back_inserter(outcomes_));
}

void Session::keepControl() {
    std::vector<ControlChange> changes;
    {
        const std::lock_guard lock{mutex_};
        changes = std::exchange(controlChanges_, {});
    }
    if (!leases_) return;
    const auto last = frame_;
    for (const auto& each : changes) each(*leases_, *last);
    const auto now = Clock::now().time_since_epoch().count();
    leases_->step(*last, Clock::duration{now - alive_} < deaf);
}

void Session::keepHolds() {
    std::vector<std::function<void(Holds&)>> changes;
    {
        const std::lock_guard lock{mutex_};
        changes = std::exchange(holdChanges_, {});
    }
    if (!holds_) return;
    for (const auto& each : changes) each(*holds_);
    const auto last = frame_;
    auto ends =
        holds_->step(*last, Clock::now(), Clock::time_point{Clock::duration{alive_.load()}});
    const std::lock_guard lock{mutex_};
    std::ranges::move(ends, std::back_inserter(holdEnds_));
}

void Session::publish() {
    const auto last = frame_;
    auto frame = std::make_shared<Frame>();
    frame->number = ++number_;
    frame->utc = utcNow();
    frame->domain = options_.domain;
    frame->joined = mirror_ != nullptr;
    frame->seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    frame->problem = problem_;
    frame->security = options_.security;
    frame->rate = appliedRate_;
    if (mirror_) {
        frame->closed = mirror_->closed();
        frame->complete = mirror_->waitUntilComplete(0ms);
        frame->control = leases_->now();
        for (const comms::AgentStatus& status : mirror_->agents()) {
            frame->agents.push_back(agentFrame(*mirror_, status));
        }
        keepLost(frame->agents);
        frame->gone = lost_.gone();
        frame->contested = mirror_->contested();
    }
    if (!sameStructures(*last, *frame)) ++structures_;
    frame->structures = structures_;
    const std::lock_guard lock{mutex_};
    frame_ = std::move(frame);
    published_ = Clock::now();
}

void Session::keepLost(std::vector<AgentFrame>& agents) {
    std::vector<std::string> dismissed;
    {
        const std::lock_guard lock{mutex_};
        dismissed = std::exchange(dismissed_, {});
    }
    for (const std::string& each : dismissed) lost_.dismiss(each);
    const auto events = lost_.update(agents, Clock::now());
    const std::lock_guard lock{mutex_};
    events_.insert(events_.end(), events.begin(), events.end());
}

bool Session::pause() {
    std::unique_lock lock{mutex_};
    changed_.wait_for(lock, framePeriod, [this] {
        return ends_ || again_ || !controlChanges_.empty() || !requests_.empty() ||
               !holdChanges_.empty();
    });
    return !ends_;
}

}  // namespace cortex::gui
