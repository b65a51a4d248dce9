// SPDX-License-Identifier: Apache-2.0
#include "loop/two_managers.hpp"

#include "cortex/core/simplex.hpp"
#include "cortex/core/system_findings.hpp"

#include <algorithm>
#include <string>

namespace cortex::cs {

Report twoManagers(AgentRuntime& agent, std::span<const std::uint32_t> managers) {
    Report report;
    const auto& simplexes = agent.structure().simplexes;
    const auto text = [&](std::uint32_t writer) {
        const std::uint32_t manager = managers[writer];
        return simplexes[writer].path + ", which " +
               (manager == noSimplex ? "nobody" : simplexes[manager].path) + " manages";
    };
    for (const SimplexInfo& demand : simplexes) {
        if (demand.remote || demand.writers.size() < 2) continue;
        const std::uint32_t first = demand.writers.front();
        const auto other = std::ranges::find_if(demand.writers, [&](std::uint32_t writer) {
            return managers[writer] != managers[first];
        });
        if (other == demand.writers.end()) continue;
        const std::uint32_t manager = managers[managers[first] != noSimplex ? first : *other];
        report.error(demand.path, finding::twoManagers, agent.simplex(manager).place(),
                     "it is written by " + text(first) + ", and by " + text(*other) +
                         ": both could have it at once",
                     "let " + simplexes[manager].path +
                         " choose between all of them, or give each a demand of its own");
    }
    return report;
}

}  // namespace cortex::cs
