// SPDX-License-Identifier: Apache-2.0
#include "live/live_json.hpp"
#include "live/loop_text.hpp"
#include "live/pinned_cpus.hpp"
#include "verbs/live_verbs.hpp"

#include <iostream>

namespace cortex::cli {

Exit listAgents(const LiveOptions& options) {
    Live live{options.network};
    live.waitForAll();
    live.printWarnings();
    viewOwnSimplexes(live);
    const auto agents = live.mirror().agents();
    const std::string others = namelessText(live.nameless());
    const Failure incomplete{NotFound, others + "; wait longer (--timeout)"};
    if (options.json && !others.empty()) throw incomplete;
    if (options.json) {
        Json list = Json::array();
        for (const auto& each : agents) {
            list.push_back(agentJson(each));
            list.back()["cpus"] = pinnedCpus(live, each.name);
            list.back()["other_self"] = each.otherSelf;
            list.back()["contested"] = contestedJson(live.mirror().contested(), each.name);
            list.back()["dropped"] = each.dropped;
            list.back()["refused"] = each.refused;
        }
        print(list);
        return Yes;
    }
    Columns columns{0};
    columns.add({"agent", "host", "state", "rate", "age", "simplexes", "cycle", "loss", "cpus",
                 "security"});
    for (const auto& each : agents) {
        const std::string cpus = pinnedCpus(live, each.name);
        columns.add({each.name, each.host, each.state, rateText(each),
                     std::to_string(milliseconds(each.age)) + " ms", std::to_string(each.simplexes),
                     std::to_string(each.cycle), std::to_string(each.loss),
                     cpus.empty() ? "-" : cpus, each.security.empty() ? "none" : each.security});
        if (!each.trouble.empty()) columns.addNote(each.trouble);
        if (!each.otherSelf.empty()) columns.addNote(each.otherSelf);
        if (!each.dropped.empty()) columns.addNote("dropped datagrams: " + each.dropped);
        if (!each.refused.empty()) columns.addNote("refused messages: " + each.refused);
    }
    columns.print(std::cout);
    if (!others.empty()) throw incomplete;
    return Yes;
}

}  // namespace cortex::cli
