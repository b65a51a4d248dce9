// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_thread.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/service_threads.hpp"

#include <exception>
#include <utility>
#include <variant>

namespace cortex::comms {
namespace {

constexpr std::chrono::milliseconds tick{20};
constexpr std::chrono::milliseconds shortTick{5};   // while something is waited for
constexpr std::chrono::milliseconds mostLate{500};  // at which a process that runs wakes up

[[noreturn]] void throwNoSuchPath(const MirrorState& state, std::string_view path) {
    std::vector<std::string> paths;
    for (const auto& [name, agent] : state.agents.all()) {
        if (!agent.structure) continue;
        for (const SimplexInfo& info : agent.structure->simplexes) {
            if (!info.remote) paths.push_back(info.path);
        }
    }
    const std::string nearest = nearestNames(path, paths);
    throw Error("no agent has a simplex " + std::string{path} +
                (nearest.empty() ? "" : "; " + nearest));
}

}  // namespace

bool MirrorState::everybodyIsHere(Mirror::Milliseconds quiet) const {
    const Moment now = std::chrono::steady_clock::now();
    return now - news >= quiet && agents.complete() && everybodyIsKnown(now);
}

bool MirrorState::isOwned(std::string_view path, Mirror::Milliseconds others) {
    const Moment now = std::chrono::steady_clock::now();
    return agents.isOwned(path, now, everybodyIsKnown(now), others);
}

bool MirrorState::everybodyIsKnown(Moment now) const {
    return nameless == 0 && agents.unheard() == 0 && !agents.awaitsAny(now);
}

MirrorThread::MirrorThread(const std::string& name, const NetworkOptions& options)
    : name_{name}, options_{options}, tool_{makeSender(name)}, state_{tool_} {
    join();
    const ServiceThreads named{"cortex-mirror"};
    thread_ = std::thread{[this] { run(); }};
}

MirrorThread::~MirrorThread() {
    change([](MirrorState& state) { state.stopping = true; });
    thread_.join();
}

void MirrorThread::run() {
    try {
        while (turn()) {
        }
    } catch (const std::exception& error) {  // the network refused an endpoint
        const std::lock_guard lock{mutex_};
        state_.failure = error.what();
    }
    changed_.notify_all();
}

// False: the mirror ends. Who is silent is judged at the moment when the samples were taken: what
// comes while they are worked on, or while listeners run, comes with the next. While the process
// stood still, nothing came.
bool MirrorThread::turn() {
    const auto pause = read([](MirrorState& state) {
        return state.commands.waiting() || !state.everybodyIsHere() ? shortTick : tick;
    });
    const Moment due = std::chrono::steady_clock::now() + pause;
    const std::uint32_t nameless =
        endpoints_->nameless();  // before: their presence may be taken now
    const auto samples = inbox_.take(due);
    const Moment taken = std::chrono::steady_clock::now();
    for (const MirrorSample& sample : samples) takeAndTell(sample);
    {
        const std::lock_guard lock{mutex_};
        if (state_.stopping) return false;
        if (taken - due > mostLate) {
            state_.agents.excuse(taken - due, taken);
            state_.tools.excuse(taken - due, taken);
        }
        serve(taken);
        state_.nameless = std::max(nameless, endpoints_->nameless());
    }
    changed_.notify_all();
    tellListeners();
    return true;
}

// The mutex is not held while listeners run, because they may call the mirror.
void MirrorThread::takeAndTell(const MirrorSample& sample) {
    std::vector<std::shared_ptr<ListenerOf<const std::string&, const AgentImage&>>> listeners;
    std::string name;
    AgentImage image;
    {
        const std::lock_guard lock{mutex_};
        const MirrorAgent* agent = take(sample, std::chrono::steady_clock::now());
        if (agent == nullptr) return;
        listeners = state_.imageListeners.list();
        if (listeners.empty()) return;
        name = agent->model.agent();
        image = agent->image();
    }
    for (const auto& listener : listeners) listener->tell(name, image);
}

const MirrorAgent* MirrorThread::take(const MirrorSample& sample, Moment now) {
    MirrorAgents& agents = state_.agents;
    if (const auto* presence = std::get_if<Presence>(&sample)) {
        agents.take(*presence, now);
        state_.tools.take(*presence, now);
    } else if (const auto* model = std::get_if<Model>(&sample)) {
        agents.take(*model, now);
    } else if (const auto* came = std::get_if<StreamBlock>(&sample)) {
        return agents.take(came->block, came->stream, now);
    } else if (const auto* summary = std::get_if<Summary>(&sample)) {
        if (state_.summarised) agents.take(*summary, now);
    } else if (const auto* answer = std::get_if<Answer>(&sample)) {
        state_.commands.take(*answer);
    } else if (const auto* message = std::get_if<EventMessage>(&sample)) {
        if (auto event = agents.take(*message)) events_.push_back(std::move(*event));
    } else if (const auto* past = std::get_if<PastMessage>(&sample)) {
        const MirrorAgent* agent = agents.find(past->name);
        if (agent != nullptr && agent->model.epoch() == past->epoch) state_.past.take(*past, now);
    } else {
        agents.withdraw(std::get<Withdrawn>(sample).agent);
        state_.tools.withdraw(std::get<Withdrawn>(sample).agent);
    }
    return nullptr;
}

// The goodbye of the former endpoints does not count, as these speak on. Throws Error where the
// network refuses it; then the former stay.
void MirrorThread::join() {
    auto next = std::make_unique<MirrorEndpoints>(options_, tool_, inbox_);
    state_.agents.judgeBy(next->identity());
    endpoints_ = std::move(next);
}

void MirrorThread::joinAnew(Moment now) {
    const bool isDeaf = endpoints_->isDeaf(), hearsAny = state_.agents.hearsAny() && !isDeaf;
    const std::int64_t time = now.time_since_epoch().count();
    if (!rejoin_.isDue(hearsAny, endpoints_->findsUnproven() || isDeaf, time)) return;
    try {
        join();
    } catch (const Error&) {
        return;  // it is due again
    }
}

void MirrorThread::serve(Moment now) {
    state_.agents.tick(state_.view, now);
    state_.tools.tick(now);
    joinAnew(now);
    state_.past.tick(state_.agents, now);
    state_.words.past = state_.past.words();
    if (state_.past.waiting()) endpoints_->hearPast();
    endpoints_->say(state_.words);
    endpoints_->view(state_.view, state_.summarised);
    if (state_.commands.waiting() || state_.mayCommand) endpoints_->command();
    if (!state_.listeners.list().empty()) endpoints_->listen();
    endpoints_->announce(state_.agents, now);
    state_.commands.tick(now, [&](const Command& command) { return endpoints_->write(command); });
    if (endpoints_->speakers() != state_.speakers) state_.news = now;
    state_.speakers = endpoints_->speakers();
    state_.closed = endpoints_->closed();
}

// The mutex is not held here, because a listener may call the mirror.
void MirrorThread::tellListeners() {
    if (events_.empty()) return;
    const auto listeners = read([](MirrorState& state) { return state.listeners.list(); });
    for (const AgentEvent& event : std::exchange(events_, {})) {
        for (const auto& listener : listeners) listener->tell(event);
    }
}

std::uint64_t MirrorThread::send(std::string_view path, std::string_view command,
                                 const Mirror::Arguments& arguments, Mirror::Milliseconds budget) {
    const std::uint64_t number = read([&](MirrorState& state) {
        MirrorAgent* owner = state.agents.ownerOf(path);
        if (owner == nullptr) throwNoSuchPath(state, path);
        return state.commands.send(owner->target(), path, command, arguments, budget,
                                   std::chrono::steady_clock::now());
    });
    inbox_.wake();
    return number;
}

std::uint64_t MirrorThread::refused() const {
    const std::lock_guard lock{mutex_};
    return state_.agents.refused() + state_.commands.refused() + state_.past.refused() +
           inbox_.dropped() + endpoints_->malformed();
}

}  // namespace cortex::comms
