// SPDX-License-Identifier: Apache-2.0
#include "live/live_json.hpp"
#include "live/loop_text.hpp"
#include "verbs/live_verbs.hpp"

#include <iostream>

namespace cortex::explorer {

Exit listAgents(const LiveOptions& options) {
    Live live{options.network};
    live.waitForAll();
    live.printWarnings();
    const auto agents = live.mirror().agents();
    if (options.json) {
        Json list = Json::array();
        for (const auto& each : agents) list.push_back(agentJson(each));
        print(list);
        return Yes;
    }
    Columns columns{0};
    columns.add(
        {"agent", "host", "state", "rate", "age", "simplexes", "cycle", "loss", "security"});
    for (const auto& each : agents) {
        columns.add({each.name, each.host, each.state, rateText(each),
                     std::to_string(milliseconds(each.age)) + " ms", std::to_string(each.simplexes),
                     std::to_string(each.cycle), std::to_string(each.loss),
                     each.security.empty() ? "none" : each.security});
        if (!each.trouble.empty()) columns.addNote(each.trouble);
    }
    columns.print(std::cout);
    return Yes;
}

}  // namespace cortex::explorer
