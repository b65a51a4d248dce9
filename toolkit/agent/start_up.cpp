// SPDX-License-Identifier: Apache-2.0
#include "start_up.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

namespace cortex::toolkit {
namespace {

// Agents that are started together see each other within this time.
constexpr std::chrono::seconds grace{1};
// A start-up without an answer, as no tick comes or a transition takes long, is over after this.
constexpr std::chrono::seconds longest{60};
std::vector<std::uint32_t> notGoodIn(const Image& image) {
    std::vector<std::uint32_t> simplexes;
    for (std::uint32_t i = 0; i < image.structure().simplexes.size(); ++i) {
        if (image.state(i).quality != Quality::Good) simplexes.push_back(i);
    }
    return simplexes;
}

// Our own active simplexes.
std::vector<std::uint32_t> activeIn(const Image& image) {
    std::vector<std::uint32_t> simplexes;
    for (std::uint32_t i = 0; i < image.structure().simplexes.size(); ++i) {
        const SimplexInfo& info = image.structure().simplexes[i];
        if (!info.remote && info.layout->type->isA("Active")) simplexes.push_back(i);
    }
    return simplexes;
}

const std::string& pathOf(const Image& image, std::uint32_t simplex) {
    return image.structure().simplexes[simplex].path;
}

bool isIn(State state, const Image& image, std::uint32_t simplex) {
    return image.get<std::int64_t>(pathOf(image, simplex), "state") == static_cast<int>(state);
}

constexpr std::string_view notLinked = "is not linked: ";  // as the links of an agent say it

}  // namespace

// Of paths that are not linked: the nearest that other agents have.
struct StartUp::Hints {
    std::mutex mutex;
    std::map<std::string, std::string> byPath;

    void note(const Event& event, const Structure& structure) {
        std::string_view text = event.text.view();
        if (event.kind != EventKind::Agent || event.simplex == noSimplex) return;
        if (!text.starts_with(notLinked)) return;
        text.remove_prefix(notLinked.size());
        const std::lock_guard lock{mutex};
        byPath[structure.simplexes[event.simplex].path] = text;
    }
    std::string of(const std::string& path) {
        const std::lock_guard lock{mutex};
        const auto hint = byPath.find(path);
        return hint == byPath.end() ? "" : "; " + hint->second;
    }
};

StartUp::StartUp(cs::ClusterCS& cluster, std::string agentName)
    : cluster_{cluster}, path_{"/" + std::move(agentName)}, hints_{std::make_shared<Hints>()} {
    cluster_.addEventSink([hints = hints_](const Event& event, const Structure& structure) {
        hints->note(event, structure);
    });
}

void StartUp::look() {
    if (complete_ || !cluster_.running()) return;
    if (!began_) began_ = Clock::now();
    if (!over_ && Clock::now() - *began_ > longest) tellOverdue();
    if (answerIsDue_) {
        CallResult answer;
        if (!cluster_.program().poll(sent_, answer)) return;
        answerIsDue_ = false;
        return tell(answer);
    }
    const Image image = cluster_.image();
    const MissingLinks missing = missingLinks(cluster_.agent());
    noteActive(image);
    if (missing == missing_ && sent_ != 0 && !mayFollowNow(image)) return;
    if (!missing.empty() && !std::exchange(told_, true)) std::cerr << missingText(missing);
    if (!missing.empty() && Clock::now() - *began_ < grace) return;
    missing_ = missing;
    const std::string stopped = shutDownSince(image);
    if (stopped.empty()) return send(image);
    std::cerr << "startup: " << stopped << " was shut down since, so the rest is left to you: "
              << "cortex call " << path_ << " startup prefix=/" << std::endl;
    notGood_.clear();
    complete_ = missing.empty();
}

void StartUp::again() {
    began_.reset();
    sent_ = 0;
    answerIsDue_ = told_ = complete_ = false;
    missing_.clear();
    started_.clear();
    notFollowed_.clear();
    notGood_.clear();
}

std::string StartUp::missingText(const MissingLinks& missing) const {
    std::string text;
    for (const auto& [path, neededBy] : missing) {
        text += "startup: " + neededBy + " waits for " + path +
                " of another agent, which is not there" + hints_->of(path) + "\n";
    }
    return text;
}

void StartUp::send(const Image& image) {
    noteActive(image);
    sent_ = cluster_.send(path_, "startup", {{"prefix", Value{std::vector<std::string>{"/"}}}});
    answerIsDue_ = true;
}

void StartUp::tell(const CallResult& answer) {
    const Image image = cluster_.image();
    noteActive(image);
    notGood_ = answer.done() ? std::vector<std::uint32_t>{} : notGoodIn(image);
    nextTry_ = Clock::now() + grace;
    complete_ = missing_.empty() && notGood_.empty();
    over_ = true;
    const std::string before =
        std::exchange(notFollowed_, answer.done() ? "" : "startup: " + answer.text() + "\n");
    const std::string faults = faultLines(image);
    if (!answer.done())
        std::cerr << (notFollowed_ == before ? "" : notFollowed_) << std::flush;
    else if (faults.empty())
        std::cout << "all active simplexes are started" << std::endl;
    else
        std::cerr << "started, but not all went on:\n" << faults << std::flush;
}

void StartUp::tellOverdue() {
    over_ = true;
    notFollowed_ =
        "startup: did not come to its end in " + std::to_string(longest.count()) + " s\n";
    std::cerr << notFollowed_ << std::flush;
}

void StartUp::noteActive(const Image& image) {
    if (!active_) active_ = activeIn(image);
    for (const std::uint32_t simplex : *active_) {
        if (isIn(State::Active, image, simplex)) started_.insert(simplex);
    }
}

// Data is good that was not when somebody did not follow, perhaps for that.
bool StartUp::mayFollowNow(const Image& image) {
    if (notGood_.empty() || Clock::now() < nextTry_) return false;
    nextTry_ = Clock::now() + grace;
    return std::ranges::any_of(notGood_, [&](std::uint32_t simplex) {
        return image.state(simplex).quality == Quality::Good;
    });
}

// Whoever stopped something meanwhile does not want it to be started again.
std::string StartUp::shutDownSince(const Image& image) const {
    const auto found = std::ranges::find_if(
        started_, [&](std::uint32_t simplex) { return isIn(State::Standby, image, simplex); });
    return found == started_.end() ? "" : pathOf(image, *found);
}

std::string StartUp::endText() const {
    return notFollowed_ + missingText(complete_ ? MissingLinks{} : missingLinks(cluster_.agent()));
}

NotStarted::NotStarted(cs::ClusterCS& cluster, std::string agentName,
                       std::optional<std::string> options)
    : cluster_{cluster},
      path_{"/" + std::move(agentName)},
      options_{std::move(options)},
      asked_{std::make_shared<std::atomic<bool>>(false)} {
    cluster_.addEventSink([asked = asked_](const Event& event, const Structure&) {
        const bool startup = event.kind == EventKind::Command &&
                             event.text.view().find("startup(") != std::string_view::npos;
        if (startup || event.kind == EventKind::StateChange) asked->store(true);
    });
}

void NotStarted::look() {
    constexpr std::chrono::seconds timeToAsk{3};
    if (!told_ && Clock::now() - began_ >= timeToAsk) tell();
}

void NotStarted::tell() {
    if (std::exchange(told_, true) || asked_->load()) return;
    constexpr std::size_t mostNamed = 3;
    const Image image = cluster_.image();
    std::string names;
    std::size_t resting = 0;
    for (const std::uint32_t simplex : activeIn(image)) {
        if (!isIn(State::Standby, image, simplex)) return;
        if (resting++ < mostNamed) names += (names.empty() ? "" : ", ") + pathOf(image, simplex);
    }
    if (resting == 0) return;
    if (resting > mostNamed) names += " and " + std::to_string(resting - mostNamed) + " more";
    std::cerr << "not started: " << names << (resting == 1 ? " is" : " are")
              << " in Standby, and nobody asked for a start-up: "
              << (options_ ? "cortex call " + path_ + " startup prefix=/" + *options_ + ", or "
                           : std::string{})
              << "start this agent with --startup" << std::endl;
}

}  // namespace cortex::toolkit
