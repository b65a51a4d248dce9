// SPDX-License-Identifier: Apache-2.0
#include "conform/bench.hpp"

#include "cortex/core/error.hpp"

#include "common/image_items.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>

namespace cortex::cli::conform {
namespace {

using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds look{20};
constexpr int clearings = 6;
constexpr int attempts = 4;
constexpr double betweenClearings = 0.5;  // s
constexpr Milliseconds backTime{3000};    // for the answer to a command that puts something back

std::string needs(const std::string& what, const comms::CommandAnswer& answer) {
    const std::string remedy = lacksControl(answer)
                                   ? "; --take takes control for the time of the tests"
                                   : "; use a tool with the right to it (--security)";
    return what + " was not allowed: " + answer.why + remedy;
}

}  // namespace

std::string stateText(const Sample& sample, std::uint32_t simplex) {
    return name(sample.stateOf(simplex));
}

Bench::Bench(Live& live, Plant plant, const Wishes& wishes)
    : live_{live}, plant_{std::move(plant)}, wishes_{wishes} {
    live_.mirror().prepareCommands();
    if (wishes_.take) takeControl();
    recording_ = std::make_unique<Recording>(live_, plant_);
}

Bench::~Bench() {
    const std::string left = putBack();
    if (!left.empty()) std::cerr << "cortex: " << printable(left) << '\n';
}

void Bench::takeControl() {
    std::vector<std::uint32_t> commanded{plant_.device};
    if (plant_.processor) commanded.push_back(*plant_.processor);
    for (const AxisPair& axis : plant_.axes) {
        for (const Mover& each : plant_.movers(axis)) {
            if (wishes_.move && std::ranges::count(commanded, each.controller) == 0)
                commanded.push_back(each.controller);
        }
    }
    for (const std::uint32_t each : commanded) {
        control_.push_back(std::make_unique<BriefControl>(live_, plant_.agent, plant_.path(each)));
    }
}

std::optional<Value> Bench::value(std::uint32_t simplex, std::string_view item) const {
    const comms::AgentImage image = live_.mirror().image(plant_.agent);
    const ItemLayout* layout = plant_.info(simplex).layout->find(item);
    if (!image || layout == nullptr || &image->structure() != plant_.structure.get()) return {};
    return image->value(simplex, *layout);
}

double Bench::constant(std::uint32_t simplex, std::string_view item, std::size_t element) const {
    const auto found = value(simplex, item);
    const std::vector<double> numbers = found ? numbersOf(*found) : std::vector<double>{};
    return element < numbers.size() ? numbers[element] : 0;
}

std::string Bench::label(std::uint32_t simplex, std::string_view item, std::int64_t number) const {
    const DataItem* found = plant_.type(simplex).findData(item);
    if (found == nullptr || !found->labels.contains(number)) return toText(number);
    return found->labels.at(number);
}

double Bench::period() const {
    return static_cast<double>(live_.statusOf(plant_.agent).period) * 1e-9;
}

comms::CommandAnswer Bench::call(std::uint32_t simplex, const std::string& command,
                                 const Arguments& arguments, double seconds,
                                 const std::function<bool()>& goesOn) {
    const std::string what = command + " of " + plant_.path(simplex);
    const Milliseconds limit = live_.timeout() + Milliseconds{std::llround(seconds * 1000)};
    const auto end = std::chrono::steady_clock::now() + limit;
    comms::Mirror& mirror = live_.mirror();
    const std::uint64_t number = mirror.send(plant_.path(simplex), command, arguments, limit);
    comms::CommandAnswer answer;
    while (!mirror.waitForAnswer(number, answer, look)) {
        const bool isOver = std::chrono::steady_clock::now() >= end || (goesOn && !goesOn());
        const bool isInterrupted = recording_->isInterruptible() && Interrupts::signal() != 0;
        if (!isOver && !isInterrupted) continue;
        mirror.abandon(number);
        if (isInterrupted) throwIfInterrupted();
        answer.outcome = Outcome::Unknown;
        answer.why = "no answer came, and it is not waited for any longer";
        return answer;
    }
    if (answer.reason == Reason::Authority) throw Ended{skipped(needs(what, answer))};
    return answer;
}

State Bench::found(std::uint32_t simplex) const {
    const auto its =
        std::ranges::find(found_, simplex, [](const auto& each) { return each.first; });
    return its == found_.end() ? now().stateOf(simplex) : its->second;
}

void Bench::bring(std::uint32_t simplex, State wanted) {
    const std::string& path = plant_.path(simplex);
    const State is = now().stateOf(simplex);
    if (std::ranges::find(found_, simplex, [](const auto& each) { return each.first; }) ==
        found_.end()) {
        if (is != State::Standby && is != State::Active) {
            throw Ended{skipped(path + " is in " + name(is) + "; look at 'cortex show " + path +
                                "', and bring it to Standby first")};
        }
        found_.emplace_back(simplex, is);
    }
    if (is == wanted) return;
    const std::string command = wanted == State::Active ? "startup" : "shutdown";
    const double limit = plant_.type(simplex).transitionTimeout + 1;
    const comms::CommandAnswer answer = call(simplex, command);
    if (answer.outcome == Outcome::Rejected)
        throw Ended{failed(path + " did not take " + command + ": " + answer.text())};
    const bool came = recording_->becomes(
        [&](const Sample& each) {
            const State state = each.stateOf(simplex);
            return state == wanted || state == State::Fault;
        },
        limit);
    const Sample last = now();
    if (came && last.stateOf(simplex) == wanted) return;
    throw Ended{failed(path + " is in " + stateText(last, simplex) + faultText(simplex) +
                       " after " + command + ", " + name(wanted) + " was expected within " +
                       toText(limit) + " s; 'cortex events " + path + "' says what happened")};
}

std::string Bench::faultText(std::uint32_t simplex) const {
    const auto text = value(simplex, "faultText");
    if (now().stateOf(simplex) != State::Fault || !text) return {};
    return " (" + toText(*text) + ")";
}

void Bench::needGood(std::uint32_t observation) const {
    const Quality quality = now().slot(observation).quality;
    if (quality == Quality::Good) return;
    throw Ended{skipped(plant_.path(observation) + " is " + name(quality) +
                        "; see 'observations are good'")};
}

void Bench::set(std::uint32_t simplex, const std::string& item, Value wanted) {
    const auto before = value(simplex, item);
    const comms::CommandAnswer answer = call(simplex, "set", {{item, wanted}});
    const std::string what = item + " of " + plant_.path(simplex);
    if (!answer.done()) throw Ended{failed(what + " cannot be set: " + answer.text())};
    if (!before || !changed_.emplace(simplex, item).second) return;
    const DataItem* data = plant_.type(simplex).findData(item);
    const bool always = data != nullptr && data->settable.has(State::Active);
    (always ? undo_ : undoAtRest_).push_back([=, this] {
        const std::string why = order(simplex, "set", {{item, *before}});
        if (!why.empty()) left_.push_back(what + ": " + why);
    });
}

// What expired was never done, so it is asked for again.
std::string Bench::order(std::uint32_t simplex, const std::string& command,
                         const Arguments& arguments) {
    std::string why;
    for (int i = 0; i < attempts; ++i) {
        try {
            const comms::CommandAnswer answer =
                live_.mirror().call(plant_.path(simplex), command, arguments, backTime);
            if (answer.done()) return {};
            why = answer.text();
            if (answer.outcome != Outcome::Expired) return why;
        } catch (const Error& error) {
            return error.what();
        }
    }
    return why;
}

// Where it is gone, putBack() says so.
void Bench::quietly(std::uint32_t simplex, const std::string& command, const Arguments& arguments) {
    order(simplex, command, arguments);
}

// A fault clears only once its cause is gone, which may take a while.
void Bench::leadBack(std::uint32_t simplex, State to) {
    const auto leads = [&](const char* command, State end, double limit) {
        quietly(simplex, command);
        const auto isThere = [&](const Sample& each) { return each.stateOf(simplex) == end; };
        return recording_->becomes(isThere, limit);
    };
    for (int i = 0; i < clearings && now().stateOf(simplex) == State::Fault; ++i) {
        if (leads("clearFaults", State::Standby, betweenClearings)) break;
    }
    if (now().stateOf(simplex) == to) return;
    leads(to == State::Active ? "startup" : "shutdown", to,
          plant_.type(simplex).transitionTimeout + 1);
}

// First all that were at rest come to rest, in the order in which they began: controllers brake on
// their ramps while the device still follows.
std::string Bench::putBack() {
    if (!recording_) return {};
    left_.clear();
    recording_->setInterruptible(false);
    try {
        for (; !undo_.empty(); undo_.pop_back()) undo_.back()();
        for (const State state : {State::Standby, State::Active}) {
            for (const auto& [simplex, before] : found_) {
                if (before == state) leadBack(simplex, before);
            }
        }
        for (; !undoAtRest_.empty(); undoAtRest_.pop_back()) undoAtRest_.back()();
        for (const auto& [simplex, before] : found_) {
            if (now().stateOf(simplex) == before) continue;
            left_.push_back(plant_.path(simplex) + " was " + name(before) + " and is now " +
                            stateText(now(), simplex));
        }
    } catch (const std::exception& error) {
        left_.emplace_back(error.what());
    }
    recording_->setInterruptible(true);
    undo_.clear();
    undoAtRest_.clear();
    changed_.clear();
    found_.clear();
    return left_.empty() ? "" : "it could not be put back: " + joined(left_, "; ");
}

}  // namespace cortex::cli::conform
