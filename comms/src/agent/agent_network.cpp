// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_network.hpp"

#include "cortex/core/clock.hpp"

#include "wire/udp_sockets.hpp"

#include <algorithm>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t aloneAfter = 3 * nsPerSecond;
constexpr std::size_t mostDomains = 4;  // that are named

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& each : words) text += (text.empty() ? "" : ", ") + each;
    return text;
}

const NetworkInterface* find(const std::vector<NetworkInterface>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &NetworkInterface::name);
    return found != all.end() ? &*found : nullptr;
}

// Addresses by which other hosts may reach this one.
std::vector<std::string> reachable(const std::vector<NetworkInterface>& interfaces) {
    std::vector<std::string> ips;
    for (const NetworkInterface& each : interfaces) {
        if (each.isUsed() && !each.loopback)
            ips.insert(ips.end(), each.ips.begin(), each.ips.end());
    }
    return ips;
}

// The same, or those of the loopback interface where there are no others.
std::vector<std::string> joinable(const std::vector<NetworkInterface>& interfaces) {
    std::vector<std::string> ips = reachable(interfaces);
    for (const NetworkInterface& each : interfaces) {
        if (ips.empty() && each.isUsed()) ips = each.ips;
    }
    return ips;
}

// "domain 3", "domains 3, 4": of which this machine has participants, but this one; none: "".
std::string otherDomains(int domain) {
    std::vector<std::string> numbers;
    for (const int each : domainsHere()) {
        if (each != domain) numbers.push_back(std::to_string(each));
    }
    if (numbers.empty()) return {};
    if (numbers.size() > mostDomains) {
        numbers.resize(mostDomains);
        numbers.emplace_back("and others");
    }
    return (numbers.size() == 1 ? "domain " : "domains ") + joined(numbers);
}

std::string lossOf(const NetworkInterface& interface) {
    if (interface.ips.empty()) return " has no address any more";
    return interface.up ? " has no carrier any more" : " is down now";
}

}  // namespace

AgentNetwork::AgentNetwork(const AgentSelf& self, NetworkOptions options)
    : self_{self},
      asked_{std::move(options)},
      known_{chosen(networkInterfaces(), asked_.interfaces)},
      joined_{joinable(known_)} {}

NetworkOptions AgentNetwork::options() {
    NetworkOptions options = asked_;
    if (onLoopback(options.domain) != OnLoopback::None) alsoOnLoopback(options);
    alsoLoopback_ = asked_.interfaces.empty() && !options.interfaces.empty();
    if (alsoLoopback_) return options;
    std::erase_if(options.interfaces, [&](const std::string& each) {
        const NetworkInterface* found = find(known_, each);
        return found != nullptr && !found->isUsed();
    });
    if (options.interfaces.empty() && !asked_.interfaces.empty()) {
        options.interfaces = {"127.0.0.1"};
    }
    return options;
}

bool AgentNetwork::look(std::uint32_t others, bool waits, std::int64_t now) {
    if (now < due_) return false;
    due_ = now + nsPerSecond;
    if (!std::exchange(begun_, true)) {
        for (const std::string& each : troublesOf(known_)) {
            self_.event(Severity::Warning, self_.simplex, each);
        }
        tellApart();
        return false;
    }
    met_ = met_ || others > 0;
    if (!told_ && now - self_.began >= aloneAfter) {
        told_ = true;
        if (!met_)
            tellAlone();
        else if (waits)
            tellElsewhere();
    }
    return follow();
}

bool AgentNetwork::keepsToLoopback() const {
    const auto isLoopback = [](const NetworkInterface& each) { return each.loopback; };
    return !asked_.interfaces.empty() && std::ranges::all_of(known_, isLoopback);
}

// Fast DDS takes the loopback interface where it is named, and where there is no other.
std::vector<NetworkInterface> AgentNetwork::used() const {
    std::vector<NetworkInterface> interfaces = known_;
    const bool named = !asked_.interfaces.empty() || alsoLoopback_;
    if (named || reachable(known_).empty()) return interfaces;
    std::erase_if(interfaces, [](const NetworkInterface& each) { return each.loopback; });
    return interfaces;
}

// Who keeps to the loopback interface and who is not on it do not meet. The later one says so.
void AgentNetwork::tellApart() const {
    if (reachable(networkInterfaces()).empty()) return;
    const Sides sides = sidesOf(asked_.domain);
    const std::string others = " others of domain " + std::to_string(asked_.domain);
    const std::string remedy = asked_.interfaces.empty()
                                   ? ": start this agent again"
                                   : ": leave --interface (CORTEX_INTERFACE) out";
    if (keepsToLoopback() && sides.others) {
        self_.event(Severity::Warning, self_.simplex,
                    "keeps to the loopback interface, on which" + others + " are not" + remedy);
    } else if (!keepsToLoopback() && !alsoLoopback_ && sides.loopback) {
        self_.event(Severity::Warning, self_.simplex,
                    "is not on the loopback interface, to which" + others + " keep" + remedy);
    }
}

void AgentNetwork::tellElsewhere() const {
    const std::string elsewhere = otherDomains(asked_.domain);
    if (elsewhere.empty()) return;
    self_.event(Severity::Warning, self_.simplex,
                "what it waits for may be in another domain, this machine has participants of " +
                    elsewhere + ": start both with one --domain");
}

void AgentNetwork::tellAlone() const {
    std::string text = "no other agent is heard on domain " + std::to_string(asked_.domain) +
                       ", interfaces " + namesOfUsed(used());
    const std::string elsewhere = otherDomains(asked_.domain);
    if (!elsewhere.empty()) {
        text +=
            "; this machine has participants of " + elsewhere + ": start both with one --domain";
    } else if (asked_.interfaces.empty() && !joined_.empty() && reachable(known_).empty()) {
        text += "; no other machine is reached, as only the loopback interface is up";
    }
    if (!asked_.peers.empty() || !asked_.discoveryServer.empty())
        text += "; it asks the named hosts";
    self_.event(Severity::Info, self_.simplex, text);
}

std::string AgentNetwork::gain(const std::vector<std::string>& has, bool joins) const {
    const bool again = std::ranges::any_of(
        has, [&](const std::string& each) { return std::ranges::count(joined_, each) > 0; });
    const char* when = joins ? "from now on" : again ? "again" : "after the next start";
    return " has the address " + joined(has) + " now; it is used " + when;
}

// Joining anew interrupts links for a moment. So another interface, while one works, is told only.
bool AgentNetwork::follow() {
    const std::vector<NetworkInterface> before =
        std::exchange(known_, chosen(networkInterfaces(), asked_.interfaces));
    if (before == known_) return false;
    const std::vector<std::string> now = joinable(known_);
    const bool works = std::ranges::any_of(
        joined_, [&](const std::string& each) { return std::ranges::count(now, each) > 0; });
    const bool isFirst = joined_.empty() && !now.empty();  // the loopback interface, too
    const bool joins = isFirst || (!works && !reachable(known_).empty());
    for (const NetworkInterface& each : known_) {
        const NetworkInterface* old = find(before, each.name);
        const auto addresses = isFirst ? joinable : reachable;
        const auto had = old != nullptr ? addresses({*old}) : std::vector<std::string>{};
        const auto has = addresses({each});
        if (had == has) continue;
        self_.event(Severity::Info, self_.simplex,
                    "interface " + each.name + (has.empty() ? lossOf(each) : gain(has, joins)),
                    EventKind::Loss);
    }
    if (joins) joined_ = now;
    return joins;
}

}  // namespace cortex::comms
