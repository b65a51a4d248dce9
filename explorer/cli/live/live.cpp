// SPDX-License-Identifier: Apache-2.0
#include "live/live.hpp"

#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "live/loop_text.hpp"
#include "text/interrupts.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <tuple>

namespace cortex::cli {
namespace {

using Milliseconds = std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

comms::NetworkOptions optionsOf(const NetworkArguments& arguments) {
    comms::NetworkOptions options;
    if (arguments.domain) options.domain = *arguments.domain;
    if (!arguments.interfaces.empty()) options.interfaces = arguments.interfaces;
    options.peers = arguments.peers;
    if (arguments.discoveryServer) options.discoveryServer = *arguments.discoveryServer;
    if (arguments.security) options.security = *arguments.security;
    return options;
}

}  // namespace

int domainOf(const NetworkArguments& arguments) { return optionsOf(arguments).domain; }

void checkPath(const std::string& path) {
    const std::string wrong = SimplexTree::pathError(path);
    if (!wrong.empty()) throw Failure{Usage, "'" + path + "': " + wrong};
}

void checkPrefix(const std::string& prefix) {
    if (prefix != "/") checkPath(prefix);
}

std::shared_ptr<Session> makeSession(const NetworkArguments& arguments) {
    comms::NetworkOptions options = optionsOf(arguments);
    const bool chosen =
        !options.interfaces.empty() || !options.peers.empty() || !options.discoveryServer.empty();
    if (!chosen && comms::onlyOnLoopback(options.domain)) {
        options.interfaces = {"127.0.0.1"};
        std::cerr << "cortex: looks on the loopback interface alone, to which all agents and tools "
                     "of domain "
                  << options.domain << " on this machine keep; --interface ADDR looks elsewhere\n";
    }
    return std::make_shared<Session>(options);
}

Live::Live(const NetworkArguments& arguments)
    : timeout_{std::llround(arguments.timeout * 1000)},
      end_{Clock::now() + timeout_},
      session_{arguments.session ? arguments.session : makeSession(arguments)} {}

// A shell goes on with the same session.
Live::~Live() {
    session_->listen({});
    session_->view({}, Session::slowRate);
}

Milliseconds Live::left() const {
    const auto left = std::chrono::duration_cast<Milliseconds>(end_ - Clock::now());
    return std::max(left, Milliseconds{1});
}

template <class Wait>
bool Live::waitInSlices(Wait wait) {
    do {
        throwIfInterrupted();
        if (wait(std::min(left(), interruptSlice))) return true;
    } while (!over());
    return false;
}

void Live::waitForAll() {
    waitInSlices([&](Milliseconds limit) { return mirror().waitUntilComplete(limit); });
    if (mirror().agents().empty()) failWithNobody();
}

bool Live::waitForValues() {
    return waitInSlices([&](Milliseconds limit) { return mirror().waitForValues(limit); });
}

std::optional<std::string> Live::waitForOwner(const std::string& path) {
    std::optional<std::string> owner;
    waitInSlices([&](Milliseconds limit) {
        owner = mirror().waitForOwner(path, limit);
        const auto agents = mirror().agents();
        return std::ranges::any_of(agents,
                                   [&](const comms::AgentStatus& each) {
                                       return each.name == owner && each.state != "lost";
                                   }) ||
               mirror().waitUntilComplete(Milliseconds{0});
    });
    return owner ? owner : mirror().ownerOf(path);  // it may have come after it was asked for
}

void Live::failWithNobody() const {
    const std::string domain = std::to_string(session_->domain());
    if (mirror().closed() > 0) {
        throw Failure{NotFound, "no agent on domain " + domain +
                                    " can be seen without security: " + closed() +
                                    "; name a folder that 'cortex security "
                                    "create-agent' made (--security FOLDER or "
                                    "CORTEX_SECURITY)"};
    }
    if (mirror().nameless() > 0) {
        throw Failure{NotFound, "no agent on domain " + domain + " is known yet: " + nameless() +
                                    " within " + limitText() + "; wait longer (--timeout)"};
    }
    throw Failure{
        NotFound,
        "no agent on domain " + domain + "; start one (cortex-agent FILE --domain " + domain +
            "), look at another domain (--domain N or CORTEX_DOMAIN), name the interface that the "
            "agents are kept to (--interface lo or CORTEX_INTERFACE), or a host that multicast "
            "does not reach "
            "(--peer HOST)"};
}

std::string Live::limitText() const {
    return toText(static_cast<double>(timeout_.count()) / 1000) + " s";
}

comms::AgentStatus Live::statusOf(const std::string& agent) const {
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.name == agent) return each;
    }
    return {};
}

std::string Live::closed() const {
    const std::uint32_t count = mirror().closed();
    return count == 0 ? ""
                      : plural(count, "participant") + " with security " +
                            (count == 1 ? "was" : "were") + " heard";
}

std::string Live::nameless() const {
    const std::uint32_t count = mirror().nameless();
    return count == 0
               ? ""
               : plural(count, "participant") + " of CorteX " + (count == 1 ? "was" : "were") +
                     " found and did not say who " + (count == 1 ? "it is" : "they are");
}

std::string Live::incomplete() const {
    std::vector<std::string> parts;
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.state != "incomplete") continue;
        const std::uint32_t all = each.types + each.simplexes;
        std::string part = std::to_string(all - each.missing) + " of " + std::to_string(all) +
                           " from " + each.name;
        if (!each.trouble.empty()) part += " (" + each.trouble + ")";
        parts.push_back(std::move(part));
    }
    if (const std::uint32_t unheard = mirror().unheard(); unheard > 0) {
        const std::size_t here = mirror().agents().size();
        parts.push_back(std::to_string(here) + " of " + std::to_string(here + unheard) + " agents");
    }
    return parts.empty() ? "" : "incomplete: " + joined(parts);
}

std::vector<std::string> Live::paths() const {
    std::vector<std::string> paths;
    for (const FoundSimplex& each : below("/")) paths.push_back(each.info().path);
    return paths;
}

FoundSimplex Live::find(const std::string& path) {
    checkPath(path);
    if (const auto owner = waitForOwner(path)) {
        FoundSimplex found{*owner, mirror().structure(*owner), 0};
        if (found.structure) {
            found.index = found.structure->find(path);
            return found;
        }
    }
    if (mirror().agents().empty()) failWithNobody();
    const std::string nearest = nearestNames(path, paths());
    const bool all = mirror().waitUntilComplete(Milliseconds{0});
    throw Failure{NotFound, (all ? "no agent has a simplex " + path
                                 : path + " was not found within " + limitText() +
                                       ", which does not mean that it is not there: " + heard()) +
                                (nearest.empty() ? "" : "; " + nearest)};
}

// What was heard until the time was over, where that is not everything.
std::string Live::heard() const {
    std::vector<std::string> parts;
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.state != "incomplete") parts.push_back(each.name + " was heard");
        if (each.state != "incomplete") continue;
        parts.push_back(each.name + " was heard, but its model did not come");
    }
    const std::string others = nameless();
    if (!others.empty()) parts.push_back(others);
    const std::string lacking = incomplete();
    return joined(parts) + (lacking.empty() ? "" : "; " + lacking) + "; wait longer (--timeout)";
}

// Who claims a path that another agent has, and who gets its commands.
std::vector<std::string> Live::contradictions() const {
    std::map<std::string, std::vector<std::string>> claims;
    std::set<std::string> lost;
    for (const comms::AgentStatus& each : mirror().agents()) {
        if (each.state == "lost") lost.insert(each.name);
    }
    for (const FoundSimplex& each : below("/")) {
        if (!lost.contains(each.agent)) claims[each.info().path].push_back(each.agent);
    }
    std::vector<std::string> found;
    for (const auto& [path, agents] : claims) {
        if (agents.size() < 2) continue;
        found.push_back("agents " + joined(agents) + " both have " + path + "; commands go to " +
                        ownerOf(path).value_or("none"));
    }
    return found;
}

void Live::printWarnings() const {
    for (const comms::AgentStatus& each : mirror().agents()) {
        const std::string trouble = loopTrouble(each);
        if (trouble.empty()) continue;
        std::cerr << "cortex: " << printable(each.name + " " + trouble) << '\n';
    }
    for (const std::string& each : contradictions()) {
        std::cerr << "cortex: " << printable(each) << '\n';
    }
    const std::string others = closed();
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

comms::AgentImage Live::values(const FoundSimplex& simplex) {
    view({simplex.info().path}, 100);
    // Of a lost agent nothing comes any more: what is known of it is all.
    const auto there = [&] {
        if (mirror().age(simplex.agent, simplex.index)) return true;
        const comms::AgentImage image = mirror().image(simplex.agent);
        return image && image.lost();
    };
    std::uint64_t images = 0;
    waitInSlices([&](Milliseconds limit) {
        if (there()) return true;
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
