// SPDX-License-Identifier: Apache-2.0
#include "cortex/comms/mirror.hpp"

#include "cortex/comms/security.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"

#include "mirror/mirror_thread.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace cortex::comms {
namespace {

// Host and process tell people which tool it is. Both are the same in containers made alike, so a
// random part tells one start from another. With security the name is that in the certificate.
std::string ownName(const std::string& tool, const NetworkOptions& options) {
    std::array<char, 64> host{};
    ::gethostname(host.data(), host.size() - 1);
    std::array<char, 7> chance{};
    std::snprintf(chance.data(), chance.size(), "%06x", std::random_device{}() & 0xff'ff'ffU);
    const std::string end = "." + std::to_string(::getpid()) + "-" + chance.data();
    const std::string owner =
        options.security.empty() ? tool : checkSecurity(options.security).agent;
    const std::string start = owner + "@" + host.data();
    return start.substr(0, sizeof(Sender::name) - 1 - end.size()) + end;
}

[[noreturn]] void refuseEmpty(const std::string& call) {
    throw std::invalid_argument{"Mirror::" + call +
                                "() was given an empty function; give one that takes what comes, "
                                "and end it with stop() of what is returned"};
}

}  // namespace

struct Mirror::Implementation {
    Implementation(const std::string& tool, const NetworkOptions& options)
        : thread{ownName(tool, options), options} {}

    MirrorThread thread;
};

Mirror::Mirror(const std::string& tool, const NetworkOptions& options)
    : implementation_{std::make_unique<Implementation>(tool, options)} {}

Mirror::~Mirror() = default;

const std::string& Mirror::name() const { return implementation_->thread.name(); }

std::vector<AgentStatus> Mirror::agents() const {
    return implementation_->thread.read([](MirrorState& state) {
        std::vector<AgentStatus> list;
        const Moment now = std::chrono::steady_clock::now();
        for (const auto& [name, agent] : state.agents.all()) list.push_back(agent.status(now));
        return list;
    });
}

std::uint32_t Mirror::unheard() const {
    return implementation_->thread.read([](MirrorState& state) { return state.agents.unheard(); });
}

bool Mirror::waitUntilComplete(Milliseconds limit, Milliseconds quiet) const {
    return implementation_->thread.waitFor(
        limit, [&](MirrorState& state) { return state.everybodyIsHere(quiet); });
}

std::uint32_t Mirror::nameless() const {
    return implementation_->thread.read([](MirrorState& state) { return state.nameless; });
}

std::uint32_t Mirror::closed() const {
    return implementation_->thread.read([](MirrorState& state) { return state.closed; });
}

std::shared_ptr<const Structure> Mirror::structure(const std::string& agent) const {
    return implementation_->thread.read([&](MirrorState& state) {
        const MirrorAgent* found = state.agents.find(agent);
        return found != nullptr ? found->structure : nullptr;
    });
}

std::optional<std::string> Mirror::ownerOf(std::string_view path) const {
    return implementation_->thread.read([&](MirrorState& state) -> std::optional<std::string> {
        const MirrorAgent* owner = state.agents.ownerOf(path);
        if (owner == nullptr) return {};
        return owner->model.agent();
    });
}

std::optional<std::string> Mirror::waitForOwner(std::string_view path, Milliseconds limit,
                                                Milliseconds quiet, Milliseconds others) const {
    bool owned = false;
    implementation_->thread.waitFor(limit, [&](MirrorState& state) {
        owned = state.isOwned(path, others);
        return owned || state.everybodyIsHere(quiet);
    });
    return owned ? ownerOf(path) : std::nullopt;
}

std::vector<Contested> Mirror::contested() const {
    return implementation_->thread.read(
        [](MirrorState& state) { return state.agents.contested(); });
}

void Mirror::view(std::vector<std::string> prefixes, std::uint32_t rate) {
    this->view({Viewed{std::move(prefixes), rate}});
}

void Mirror::view(const std::vector<Viewed>& views) {
    MirrorView view = viewOf(views);
    implementation_->thread.change([&](MirrorState& state) {
        if (state.view == view) return;
        state.view = std::move(view);
        state.agents.view(state.view);
    });
}

bool Mirror::waitForValues(Milliseconds limit) const {
    return implementation_->thread.waitFor(
        limit, [](MirrorState& state) { return state.agents.valuesComplete(state.view); });
}

AgentImage Mirror::image(const std::string& agent) const {
    return implementation_->thread.read([&](MirrorState& state) {
        const MirrorAgent* found = state.agents.find(agent);
        return found != nullptr ? found->image() : AgentImage{};
    });
}

void Mirror::viewSummary(bool wanted) {
    implementation_->thread.change([&](MirrorState& state) {
        state.summarised = wanted;
        if (!wanted) state.agents.forgetSummaries();
    });
}

std::vector<SimplexMark> Mirror::summary(const std::string& agent) const {
    return implementation_->thread.read([&](MirrorState& state) {
        const MirrorAgent* found = state.summarised ? state.agents.find(agent) : nullptr;
        return found != nullptr ? found->marks(std::chrono::steady_clock::now())
                                : std::vector<SimplexMark>{};
    });
}

std::optional<double> Mirror::age(const std::string& agent, std::uint32_t simplex) const {
    return implementation_->thread.read([&](MirrorState& state) -> std::optional<double> {
        const MirrorAgent* found = state.agents.find(agent);
        if (found == nullptr || !found->tables) return {};
        return found->tables->age(simplex, std::chrono::steady_clock::now());
    });
}

std::vector<std::optional<double>> Mirror::ages(const std::string& agent) const {
    return implementation_->thread.read([&](MirrorState& state) {
        std::vector<std::optional<double>> ages;
        const MirrorAgent* found = state.agents.find(agent);
        if (found == nullptr || !found->tables) return ages;
        const Moment now = std::chrono::steady_clock::now();
        const auto count = static_cast<std::uint32_t>(found->structure->simplexes.size());
        ages.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) ages.push_back(found->tables->age(i, now));
        return ages;
    });
}

std::uint64_t Mirror::waitForImage(std::uint64_t last, Milliseconds limit) const {
    std::uint64_t images = last;
    implementation_->thread.waitFor(limit, [&](MirrorState& state) {
        images = state.agents.images();
        return images > last;
    });
    return images;
}

void Mirror::prepareCommands() {
    implementation_->thread.change([](MirrorState& state) { state.mayCommand = true; });
}

void Mirror::actFor(const std::string& person) {
    constexpr std::size_t longest = 31;
    const bool plain =
        std::ranges::none_of(person, [](unsigned char each) { return each < ' ' || each == 127U; });
    if (person.size() > longest || !plain) {
        throw Error(
            "a command is on behalf of a name of at most 31 bytes, without control "
            "characters");
    }
    implementation_->thread.read([&](MirrorState& state) { state.commands.actFor(person); });
}

void Mirror::introduce(const std::string& person) {
    if (!isPersonName(person)) {
        throw Error(
            "the name of who uses a tool has 1 to 63 bytes of UTF-8, no control characters and "
            "brackets, and no blank at its ends");
    }
    implementation_->thread.change([&](MirrorState& state) { state.words.person = person; });
}

std::vector<ToolStatus> Mirror::tools() const {
    return implementation_->thread.read([](MirrorState& state) { return state.tools.list(); });
}

void Mirror::tellAsks(const ControlAsk& asks,
                      std::vector<std::pair<std::string, std::uint64_t>> refuses) {
    if (asks.number != 0 && !canBeAskedFor(asks.prefix)) {
        throw Error("control can be asked for of / or of a path of at most 127 bytes, not of '" +
                    printable(asks.prefix) + "'");
    }
    implementation_->thread.change([&](MirrorState& state) {
        if (asks.number != 0 && state.words.person.empty())
            throw Error("say who uses the program before it asks for control (introduce)");
        state.words.asks = asks;
        state.words.refuses = std::move(refuses);
    });
}

std::uint64_t Mirror::send(std::string_view path, std::string_view command,
                           const Arguments& arguments, Milliseconds budget) {
    return implementation_->thread.send(path, command, arguments, budget);
}

bool Mirror::poll(std::uint64_t number, CommandAnswer& answer) {
    return implementation_->thread.read(
        [&](MirrorState& state) { return state.commands.poll(number, answer, &answer.latency); });
}

bool Mirror::waitForAnswer(std::uint64_t number, CommandAnswer& answer, Milliseconds limit) {
    return implementation_->thread.waitFor(limit, [&](MirrorState& state) {
        return state.commands.poll(number, answer, &answer.latency);
    });
}

void Mirror::abandon(std::uint64_t number) {
    implementation_->thread.read([&](MirrorState& state) { state.commands.abandon(number); });
}

CommandAnswer Mirror::call(std::string_view path, std::string_view command,
                           const Arguments& arguments, Milliseconds timeout) {
    const std::uint64_t number = send(path, command, arguments, timeout);
    CommandAnswer answer;
    if (waitForAnswer(number, answer, timeout)) return answer;
    abandon(number);
    answer.outcome = Outcome::Unknown;
    answer.why = "no answer within " + std::to_string(timeout.count()) + " ms";
    return answer;
}

Listening Mirror::onEvent(std::function<void(const AgentEvent&)> listener) {
    if (!listener) refuseEmpty("onEvent");
    Listening listening;
    implementation_->thread.change(
        [&](MirrorState& state) { listening = state.listeners.add(std::move(listener)); });
    return listening;
}

Listening Mirror::onImage(std::function<void(const std::string&, const AgentImage&)> listener) {
    if (!listener) refuseEmpty("onImage");
    Listening listening;
    implementation_->thread.change(
        [&](MirrorState& state) { listening = state.imageListeners.add(std::move(listener)); });
    return listening;
}

void Listening::stop() {
    if (const auto listener = listener_.lock()) listener->stop();
}

bool Mirror::eventsComplete() const {
    return implementation_->thread.read(
        [](MirrorState& state) { return state.agents.eventsComplete(); });
}

std::uint64_t Mirror::askPast(const std::string& agent, std::int64_t from, std::int64_t until) {
    std::uint64_t number = 0;
    implementation_->thread.change(
        [&](MirrorState& state) { number = state.past.ask(agent, from, until); });
    return number;
}

bool Mirror::pollPast(std::uint64_t number, PastEvents& past) {
    return implementation_->thread.read(
        [&](MirrorState& state) { return state.past.poll(number, past); });
}

PastEvents Mirror::abandonPast(std::uint64_t number) {
    PastEvents past;
    implementation_->thread.change([&](MirrorState& state) { past = state.past.giveUp(number); });
    return past;
}

std::uint64_t Mirror::refused() const { return implementation_->thread.refused(); }

std::map<std::string, Refused> Mirror::refusals() const {
    return implementation_->thread.refusals();
}

}  // namespace cortex::comms
