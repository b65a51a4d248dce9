// SPDX-License-Identifier: Apache-2.0
#include "live/live_json.hpp"

#include "live/live_values.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace cortex::cli {

std::int64_t milliseconds(double seconds) { return std::llround(seconds * 1000); }

Json agentJson(const comms::AgentStatus& agent) {
    return {{"name", agent.name},
            {"epoch", agent.epoch},
            {"host", agent.host},
            {"state", agent.state},
            {"age_ms", milliseconds(agent.age)},
            {"simplexes", agent.simplexes},
            {"cycle", agent.cycle},
            {"loss", agent.loss},
            {"security", agent.security},
            {"rate_hz", agent.rate > 0 ? Json(agent.rate) : Json()},
            {"standstill", agent.standstill}};
}

Json contestedJson(const comms::Contested& contested) {
    return {{"path", contested.path},
            {"agents", contested.agents},
            {"owner", contested.owner},
            {"why", contested.why}};
}

Json contestedJson(const std::vector<comms::Contested>& all, const std::string& agent) {
    Json list = Json::array();
    for (const comms::Contested& each : all) {
        if (std::ranges::count(each.agents, agent) > 0) list.push_back(contestedJson(each));
    }
    return list;
}

Json eventJson(const comms::AgentEvent& event) {
    return {{"time", common::utcText(event.wallClock)},
            {"agent", event.agent},
            {"number", event.number},
            {"repeatable", event.repeatable ? Json(*event.repeatable) : Json()},
            {"cycle", event.cycle},
            {"severity", name(event.severity)},
            {"kind", event.kind},
            {"path", event.path},
            {"text", event.text}};
}

void printLine(const Json& json) {
    std::cout << json.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
}

}  // namespace cortex::cli
