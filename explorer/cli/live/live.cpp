// SPDX-License-Identifier: Apache-2.0
#include "live/live.hpp"

#include "cortex/core/error.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/value.hpp"

#include "live/contests.hpp"
#include "live/loop_text.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <ranges>
#include <tuple>

namespace cortex::cli {
namespace {

using Milliseconds = std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// Agents that start together are found one after the other, those of other hosts later.
constexpr Milliseconds nobodyNew{1000};

double defaultTimeout() {
    const char* text = std::getenv("CORTEX_TIMEOUT");
    if (text == nullptr) return usualTimeout;
    const std::optional<double> seconds = toFloat(text);
    if (seconds && *seconds >= shortestTimeout && *seconds <= longestTimeout) return *seconds;
    throw Error{"CORTEX_TIMEOUT is '" + std::string{text} + "'; set it to seconds, a number from " +
                toText(shortestTimeout) + " to " + std::to_string(std::llround(longestTimeout)) +
                ", or unset it for " + toText(usualTimeout) + " s"};
}

// Of a verb in a shell, that of the shell.
Milliseconds timeoutOf(const NetworkArguments& arguments) {
    if (!arguments.timeout && arguments.session) return arguments.session->timeout();
    const double seconds = arguments.timeout ? *arguments.timeout : defaultTimeout();
    return Milliseconds{std::llround(seconds * 1000)};
}

// Whether nobody has said how long to wait.
bool isUsual(const NetworkArguments& arguments) {
    return !arguments.timeout && !arguments.session && std::getenv("CORTEX_TIMEOUT") == nullptr;
}

}  // namespace

comms::NetworkOptions optionsOf(const NetworkArguments& arguments) {
    comms::NetworkOptions options;
    if (arguments.domain) options.domain = *arguments.domain;
    if (!arguments.interfaces.empty()) options.interfaces = arguments.interfaces;
    options.peers = arguments.peers;
    if (arguments.discoveryServer) options.discoveryServer = *arguments.discoveryServer;
    if (arguments.security) options.security = *arguments.security;
    return options;
}

int domainOf(const NetworkArguments& arguments) { return optionsOf(arguments).domain; }

void checkPath(const std::string& path) {
    const std::string wrong = SimplexTree::pathError(path);
    if (wrong.empty()) return;
    const std::string simplex = path.substr(0, path.find('.'));
    const bool isItem = simplex != path && SimplexTree::pathError(simplex).empty();
    throw Failure{
        Usage,
        "'" + path + "': " +
            (isItem ? "an item has no path of its own; name its simplex: " + simplex : wrong)};
}

void checkPrefix(const std::string& prefix) {
    if (prefix != "/") checkPath(prefix);
}

std::shared_ptr<Session> makeSession(const NetworkArguments& arguments) {
    const Milliseconds timeout = timeoutOf(arguments);
    comms::NetworkOptions options = optionsOf(arguments);
    const bool chosen =
        !options.interfaces.empty() || !options.peers.empty() || !options.discoveryServer.empty();
    const comms::OnLoopback there = comms::onLoopback(options.domain);
    if (!chosen && there == comms::OnLoopback::All) {
        options.interfaces = {"127.0.0.1"};
        std::cerr << "cortex: looks on the loopback interface alone, to which all agents and tools "
                     "of domain "
                  << options.domain << " on this machine keep; --interface ADDR looks elsewhere\n";
    }
    if (!chosen && there == comms::OnLoopback::Some) comms::alsoOnLoopback(options);
    if (!chosen && there == comms::OnLoopback::None) comms::onNamedInterfaces(options);
    if (const std::string trouble = comms::networkTrouble(options); !trouble.empty())
        throw Failure{NotFound, trouble};
    return std::make_shared<Session>(options, optionsOf(arguments).interfaces, timeout);
}

Live::Live(const NetworkArguments& arguments)
    : patience_{timeoutOf(arguments), isUsual(arguments), Clock::now()},
      session_{arguments.session ? arguments.session : makeSession(arguments)} {}

// A shell goes on with the same session.
Live::~Live() {
    session_->listen({});
    session_->view({}, Session::slowRate);
    session_->actFor({});
}

// Agents, and the parts of their models that have come.
std::uint64_t Live::known() const {
    std::uint64_t known = 0;
    for (const comms::AgentStatus& each : mirror().agents())
        known += 1 + each.types + each.simplexes - each.missing;
    return known;
}

template <class Wait>
bool Live::waitInSlices(Wait wait) {
    do {
        throwIfInterrupted();
        if (wait(std::min(left(), interruptSlice))) return true;
        patience_.know(known(), mirror().nameless(), Clock::now());
    } while (!over());
    return false;
}

bool Live::waitForAny() {
    everybodyCame_ =
        waitInSlices([&](Milliseconds limit) { return mirror().waitUntilComplete(limit); });
    return !mirror().agents().empty();
}

void Live::waitForAll(const std::string& prefix) {
    if (!waitForAny()) failWithNobody();
    const bool found = waitInSlices([&](Milliseconds limit) {
        return !below(prefix).empty() || mirror().waitUntilComplete(limit, nobodyNew);
    });
    everybodyCame_ = everybodyCame_ && found;
}

bool Live::waitForValues() {
    return waitInSlices([&](Milliseconds limit) { return mirror().waitForValues(limit); });
}

std::optional<std::string> Live::waitForOwner(const std::string& path, Milliseconds others) {
    std::optional<std::string> owner;
    waitInSlices([&](Milliseconds limit) {
        owner = mirror().waitForOwner(path, limit, nobodyNew, others);
        return owner || mirror().waitUntilComplete(Milliseconds{0}, nobodyNew);
    });
    return owner ? owner : mirror().ownerOf(path);  // it may have come after it was asked for
}

Trouble Live::nobody() const {
    Nobody found{.domain = session_->domain(),
                 .waited = patience_.whole(),
                 .interfaces = session_->named(),
                 .server = session_->discoveryServer(),
                 .otherDomains = otherDomains(),
                 .closed = mirror().closed(),
                 .nameless = nameless(),
                 .strangers = strangers(),
                 .refused = refusedHere()};
    return troubleOf(found);
}

std::vector<int> Live::otherDomains() const {
    std::vector<int> domains = comms::domainsHere();
    std::erase(domains, session_->domain());
    return domains;
}

std::uint64_t Live::strangers() const {
    const auto refusals = mirror().refusals();
    const auto found = refusals.find("security refused their sender");
    return found != refusals.end() ? found->second.count : 0;
}

void Live::failWithNobody() const {
    const Trouble trouble = nobody();
    throw Failure{NotFound, trouble.what + "; " + trouble.remedy};
}

std::string Live::limitText() const {
    return toText(static_cast<double>(patience_.whole().count()) / 1000) + " s";
}

comms::AgentStatus Live::statusOf(const std::string& agent) const {
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.name == agent) return each;
    }
    return {};
}

std::string Live::incomplete() const {
    std::vector<std::string> parts;
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.state == "lost" && !each.ended && !everybodyCame_) {
            parts.push_back(each.name + " is not heard");
        }
        if (each.state != "incomplete") continue;
        const std::uint32_t all = each.types + each.simplexes;
        std::string part = std::to_string(all - each.missing) + " of " + std::to_string(all) +
                           " from " + each.name;
        if (!each.trouble.empty()) part += " (" + each.trouble + ")";
        parts.push_back(std::move(part));
    }
    if (const std::uint32_t unheard = mirror().unheard(); unheard > 0) {
        const auto agents = mirror().agents();
        const auto here = static_cast<std::size_t>(
            std::ranges::count_if(agents, [](const auto& each) { return each.state != "lost"; }));
        parts.push_back(std::to_string(here) + " of " + std::to_string(here + unheard) + " agents");
    }
    const std::string others = namelessText(nameless());
    if (!others.empty()) parts.push_back(others);
    return parts.empty() ? "" : "incomplete: " + joined(parts);
}

std::string Live::refusedHere() const {
    std::vector<std::string> parts;
    for (const auto& [reason, refused] : mirror().refusals()) {
        const std::string from = refused.lastFrom.empty() ? "" : ", the last from ";
        parts.push_back(std::to_string(refused.count) + " (" + reason + from + refused.lastFrom +
                        ")");
    }
    return parts.empty() ? "" : "this tool itself refused messages: " + joined(parts);
}

std::vector<std::string> Live::paths() const {
    std::vector<std::string> paths;
    for (const FoundSimplex& each : below("/")) paths.push_back(each.info().path);
    return paths;
}

void Live::failIfNothingIsAt(const std::string& prefix) const {
    if (!below(prefix).empty() || !incomplete().empty()) return;
    const std::string nearest = nearestNames(prefix, paths());
    throw Failure{NotFound, "no agent has anything at or below " + prefix +
                                (nearest.empty() ? "" : "; " + nearest)};
}

FoundSimplex Live::find(const std::string& path, Milliseconds others) {
    checkPath(path);
    if (const auto owner = waitForOwner(path, others)) {
        FoundSimplex found{*owner, mirror().structure(*owner), 0};
        if (found.structure) {
            found.index = found.structure->find(path);
            tellContest(path);
            return found;
        }
    }
    if (const auto contest = contestOf(path)) throw Failure{NotFound, printable(contest->text)};
    if (mirror().agents().empty()) failWithNobody();
    const std::string nearest = nearestNames(path, paths());
    const bool all = mirror().waitUntilComplete(Milliseconds{0}, nobodyNew);
    throw Failure{NotFound, (all ? "no agent has a simplex " + path + elsewhere()
                                 : path + " was not found within " + limitText() +
                                       ", which does not mean that it is not there: " + heard()) +
                                (nearest.empty() ? "" : "; " + nearest)};
}

// Where a simplex may be that no agent has which can be seen.
std::string Live::elsewhere() const {
    const std::string others = closedText(mirror().closed());
    if (!others.empty())
        return " that can be seen without security: " + others + "; " + nameAFolder;
    const std::string domains = domainsText(otherDomains());
    return domains.empty()
               ? ""
               : " on domain " + std::to_string(session_->domain()) +
                     ", while this machine has participants of " + domains + " (--domain N)";
}

// What was heard until the time was over, where that is not everything.
std::string Live::heard() const {
    std::vector<std::string> parts;
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.state != "incomplete") parts.push_back(each.name + " was heard");
        if (each.state != "incomplete") continue;
        parts.push_back(each.name + " was heard, but its model did not come");
    }
    const std::string lacking = incomplete();
    return joined(parts) + (lacking.empty() ? "" : "; " + lacking) + "; wait longer (--timeout)";
}

std::optional<comms::Contested> Live::contestOf(const std::string& path) const {
    for (comms::Contested& each : mirror().contested()) {
        if (each.path == path) return std::move(each);
    }
    return {};
}

void Live::tellContest(const std::string& path) {
    const auto contest = contestOf(path);
    if (!contest || !told_.insert(path).second) return;
    std::cerr << "cortex: " << printable(contest->text) << '\n';
}

void Live::printWarnings() const {
    for (const comms::AgentStatus& each : mirror().agents()) {
        const std::string trouble = loopTrouble(each);
        if (trouble.empty()) continue;
        std::cerr << "cortex: " << printable(each.name + " " + trouble) << '\n';
    }
    for (const std::string& each : contestLines(mirror().contested())) {
        std::cerr << "cortex: " << each << '\n';
    }
    const std::string refused = refusedHere();
    if (!refused.empty()) std::cerr << "cortex: " << printable(refused) << '\n';
    printClosed();
}

void Live::printClosed() const {
    const std::string others = closedText(mirror().closed());
    if (others.empty()) return;
    std::cerr << "cortex: " << others
              << "; --security FOLDER shows what this tool may see of them\n";
}

// One path may have several agents.
std::vector<FoundSimplex> Live::below(const std::string& prefix) const {
    std::vector<FoundSimplex> found;
    for (const comms::AgentStatus& agent : mirror().agents()) {
        const auto structure = mirror().structure(agent.name);
        if (!structure) continue;
        for (std::uint32_t i = 0; i < structure->simplexes.size(); ++i) {
            const SimplexInfo& info = structure->simplexes[i];
            if (!info.remote && isAtOrBelow(info.path, prefix)) {
                found.push_back({agent.name, structure, i});
            }
        }
    }
    std::ranges::sort(found, {},
                      [](const auto& each) { return std::tie(each.info().path, each.agent); });
    return found;
}

comms::AgentImage Live::values(const FoundSimplex& simplex,
                               const std::vector<std::uint32_t>& others) {
    std::vector<std::string> paths{simplex.info().path};
    for (const std::uint32_t each : others)
        paths.push_back(simplex.structure->simplexes[each].path);
    view(std::move(paths), 100);
    const auto came = [&](std::uint32_t each) {
        return mirror().age(simplex.agent, each).has_value();
    };
    // Of a lost agent nothing comes any more: what is known of it is all.
    const auto isLost = [&] {
        const comms::AgentImage image = mirror().image(simplex.agent);
        return image && image.lost();
    };
    const auto there = [&] { return came(simplex.index) || isLost(); };
    std::uint64_t images = 0;
    waitInSlices([&](Milliseconds limit) {
        if (there() && (std::ranges::all_of(others, came) || isLost())) return true;
        images = mirror().waitForImage(images, limit);
        return false;
    });
    auto image = mirror().image(simplex.agent);
    const bool newer = image && &image->structure() != simplex.structure.get();
    if (image && !newer && there()) return image;
    throw Failure{NotFound, "the values of " + simplex.info().path + " did not come from agent " +
                                simplex.agent};
}

}  // namespace cortex::cli
