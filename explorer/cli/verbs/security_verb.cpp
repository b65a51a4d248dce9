// SPDX-License-Identifier: Apache-2.0
#include "verbs/security_verb.hpp"

#include "cortex/comms/security.hpp"

#include <iostream>

namespace cortex::cli {
namespace {

std::string powersOf(const comms::AgentRights& rights) {
    if (rights.mayCommand.empty()) return "only look";
    if (rights.mayCommand.front() == "/") return "look, and command everything";
    return "look, and command what is at and below " + joined(rights.mayCommand);
}

std::string ownsOf(const comms::AgentRights& rights) {
    return rights.owns.empty() ? "what it has first" : joined(rights.owns);
}

std::string domainsOf(const comms::AgentRights& rights) {
    std::vector<std::string> domains;
    for (const int each : rights.domains) domains.push_back(std::to_string(each));
    return domains.empty() ? "all" : joined(domains);
}

Json jsonOf(const std::string& folder, const comms::AgentRights& rights) {
    return {{"folder", folder},    {"agent", rights.agent},     {"may_command", rights.mayCommand},
            {"owns", rights.owns}, {"domains", rights.domains}, {"until", rights.until}};
}

void printRights(const comms::AgentRights& rights) {
    Columns columns{2};
    columns.add({"agent", rights.agent});
    columns.add({"may", powersOf(rights)});
    columns.add({"owns", ownsOf(rights)});
    columns.add({"domains", domainsOf(rights)});
    columns.add({"until", rights.until});
    columns.print(std::cout);
}

}  // namespace

Exit makeAuthority(const SecurityOptions& options) {
    const std::string& folder = options.authority;
    comms::createAuthority(folder, options.days > 0 ? options.days : comms::authorityDays);
    if (options.json) {
        print({{"folder", folder}});
        return Yes;
    }
    const std::string shown = printable(folder);
    std::cout << "made " << shown << ": an authority for identities and one for permissions.\n"
              << "Whoever has its two keys can make any agent: keep it off the machines that run "
                 "agents.\nNext: cortex security create-agent NAME --authority "
              << shown << '\n';
    return Yes;
}

Exit makeAgent(const SecurityOptions& options) {
    comms::AgentRights rights;
    rights.agent = options.agent;
    rights.domains = options.domains;
    if (options.readOnly) rights.mayCommand.clear();
    if (!options.mayCommand.empty()) rights.mayCommand = options.mayCommand;
    rights.owns = options.owns;
    const std::string folder = options.folder.empty() ? options.agent : options.folder;
    rights = comms::createAgent(options.authority, folder, rights,
                                options.days > 0 ? options.days : comms::agentDays);
    if (options.json) {
        print(jsonOf(folder, rights));
        return Yes;
    }
    const std::string shown = printable(folder);
    std::cout << "made " << shown << ":\n";
    printRights(rights);
    std::cout << "Next: bring it, and nothing else, to the machine of " << rights.agent
              << ", readable by its user alone; then\n  cortex-agent SYSTEM.xml --security "
              << shown << "\n  cortex agents --security " << shown
              << "\nor, for both: export CORTEX_SECURITY=" << shown << '\n';
    return Yes;
}

Exit showSecurity(const SecurityOptions& options) {
    const comms::AgentRights rights = comms::checkSecurity(options.folder);
    if (options.json) {
        print(jsonOf(options.folder, rights));
        return Yes;
    }
    std::cout << printable(options.folder) << " can be used:\n";
    printRights(rights);
    return Yes;
}

}  // namespace cortex::cli
