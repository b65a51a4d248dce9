// SPDX-License-Identifier: Apache-2.0
#include "live/nobody.hpp"

#include "cortex/core/value.hpp"

#include "common/no_agent.hpp"
#include "text/plain_text.hpp"

#include <cstddef>

namespace cortex::cli {
namespace {

constexpr std::chrono::milliseconds enough{1000};  // for an agent that is there
constexpr std::size_t mostDomains = 8;             // that are named

std::string secondsText(std::chrono::milliseconds time) {
    return toText(static_cast<double>(time.count()) / 1000) + " s";
}

// Nothing at all was heard.
Trouble silenceOf(const Nobody& nobody, std::string what) {
    const std::string start =
        " one (cortex-agent FILE --domain " + std::to_string(nobody.domain) + ")";
    const std::string others = domainsText(nobody.otherDomains);
    const std::string leave = "leave --interface (CORTEX_INTERFACE) out";
    const std::string look = "name their domain (--domain N or CORTEX_DOMAIN)";
    if (!nobody.interfaces.empty()) what += " is heard on interface " + joined(nobody.interfaces);
    if (!others.empty()) what += ", while this machine has participants of " + others;
    if (!nobody.interfaces.empty())
        return {what, leave + ", or " + (others.empty() ? "start" + start : look)};
    if (!others.empty()) return {what, look + ", or start" + start};
    return {what, "start" + start +
                      ", look at another domain (--domain N or CORTEX_DOMAIN), or name a host that "
                      "multicast does not reach (--peer HOST)"};
}

}  // namespace

std::string domainsText(const std::vector<int>& domains) {
    if (domains.empty()) return {};
    std::vector<std::string> numbers;
    for (const int each : domains) {
        if (numbers.size() == mostDomains) break;
        numbers.push_back(std::to_string(each));
    }
    if (numbers.size() < domains.size()) numbers.emplace_back("and others");
    return (domains.size() == 1 ? "domain " : "domains ") + joined(numbers);
}

std::string closedText(std::uint32_t count) {
    if (count == 0) return {};
    return plural(count, "participant") + " with security " + (count == 1 ? "was" : "were") +
           " heard";
}

std::string namelessText(std::uint32_t count) {
    if (count == 0) return {};
    return plural(count, "participant") + " of CorteX " + (count == 1 ? "was" : "were") +
           " found and did not say who " + (count == 1 ? "it is" : "they are");
}

Trouble troubleOf(const Nobody& nobody) {
    const std::string none = common::noAgent(nobody.domain, nobody.server);
    if (nobody.closed > 0) {
        return {none + " can be seen without security: " + closedText(nobody.closed), nameAFolder,
                true};
    }
    if (nobody.strangers > 0) {
        return {none +
                    " can be seen: participants without security, or of another authority than "
                    "that of this tool's folder, were refused",
                "leave --security (CORTEX_SECURITY) out if those agents have none, or name a "
                "folder of their authority",
                true};
    }
    if (nobody.nameless > 0) {
        return {none + " is known yet: " + namelessText(nobody.nameless) + " within " +
                    secondsText(nobody.waited),
                "wait longer (--timeout)"};
    }
    if (!nobody.refused.empty()) return {none, nobody.refused};
    if (nobody.waited < enough)
        return {none + " was heard within " + secondsText(nobody.waited),
                "wait longer (--timeout)"};
    if (nobody.server.empty()) return silenceOf(nobody, none);
    return {none + " is heard", common::serverRemedy(nobody.server)};
}

}  // namespace cortex::cli
