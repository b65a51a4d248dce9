// SPDX-License-Identifier: Apache-2.0
#include "live/top_data.hpp"

#include "live/live_json.hpp"
#include "live/live_values.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <tuple>

namespace cortex::cli {
namespace {

constexpr std::size_t mostTasks = 10;

std::int64_t now() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

Json itemsOf(const Image& image, std::uint32_t simplex) {
    Json items = Json::object();
    for (const ItemLayout& each : image.structure().simplexes[simplex].layout->items) {
        items[each.item->name] = valueJson(*each.item, image.value(simplex, each));
    }
    return items;
}

TopFault faultOf(const Image& image, std::uint32_t simplex, const std::string& agent) {
    return {image.structure().simplexes[simplex].path, agent,
            common::itemOf<std::string>(image, simplex, "faultText").value_or(""),
            common::itemOf<std::int64_t>(image, simplex, "faultCode").value_or(0)};
}

std::optional<double> taskTimeOf(const Image& image, std::uint32_t simplex) {
    return common::itemOf<double>(image, simplex, "taskTime");
}

Json countsJson(const auto& counts, auto enumerator) {
    Json json = Json::object();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        json[name(static_cast<decltype(enumerator)>(i))] = counts[i];
    }
    return json;
}

}  // namespace

std::uint32_t ownSimplex(const Structure& structure) {
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (!info.remote && info.layout->type->isA("Agent")) return i;
    }
    return noSimplex;
}

std::optional<double> TopAgent::metric(const char* item) const {
    if (!loop.is_object()) return {};
    const auto found = loop.find(item);
    if (found == loop.end() || !found->is_number()) return {};
    return found->get<double>();
}

bool TopFrame::anyAgent() const {
    return std::ranges::any_of(agents,
                               [](const TopAgent& each) { return each.status.state != "lost"; });
}

TopView::TopView(Live& live, std::string prefix, std::uint32_t rate)
    : live_{live}, prefix_{std::move(prefix)}, rate_{rate} {
    view();
}

bool TopView::shows(std::string_view path) const {
    if (prefix_ == "/" || path == prefix_) return true;
    return path.starts_with(prefix_) && path[prefix_.size()] == '/';
}

void TopView::view() {
    std::vector<std::string> wanted{prefix_};
    for (const comms::AgentStatus& agent : live_.mirror().agents()) {
        const auto structure = live_.mirror().structure(agent.name);
        const std::uint32_t own = structure ? ownSimplex(*structure) : noSimplex;
        if (own == noSimplex || shows(structure->simplexes[own].path)) continue;
        wanted.push_back(structure->simplexes[own].path);
    }
    if (wanted == viewed_) return;
    live_.view(wanted, rate_);
    viewed_ = std::move(wanted);
}

TopFrame TopView::frame() {
    view();
    TopFrame frame;
    frame.time = now();
    for (const comms::AgentStatus& each : live_.mirror().agents()) add(frame, each);
    frame.contested = live_.mirror().contested();
    std::erase_if(frame.contested, [&](const auto& each) { return !shows(each.path); });
    std::ranges::sort(frame.agents, {}, [](const TopAgent& each) {  // trouble first
        return std::tuple{each.status.state == "running", each.status.name};
    });
    std::ranges::sort(frame.tasks, std::ranges::greater{}, &TopTask::time);
    frame.tasks.resize(std::min(frame.tasks.size(), mostTasks));
    return frame;
}

void TopView::add(TopFrame& frame, const comms::AgentStatus& status) const {
    TopAgent& agent = frame.agents.emplace_back();
    agent.status = status;
    const comms::AgentImage image = live_.mirror().image(status.name);
    if (!image) return;
    const Structure& structure = image->structure();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (info.remote || !shows(info.path)) continue;
        ++agent.qualities[static_cast<std::size_t>(image->state(i).quality)];
        const auto state = isLive(image, i) ? stateOf(image, i) : std::nullopt;
        if (!state) continue;
        ++agent.states[static_cast<std::size_t>(*state)];
        if (const auto time = taskTimeOf(*image, i)) {
            frame.tasks.push_back({info.path, status.name, *time});
        }
        if (*state == State::Fault) frame.faults.push_back(faultOf(*image, i, status.name));
    }
    const std::uint32_t own = ownSimplex(structure);
    if (own != noSimplex && isLive(image, own)) {
        agent.loop = itemsOf(*image, own);
    }
}

Json topJson(const TopFrame& frame) {
    Json agents = Json::array(), tasks = Json::array(), faults = Json::array(),
         contested = Json::array(), events = Json::array();
    for (const TopAgent& each : frame.agents) {
        Json agent = agentJson(each.status);
        agent["period_us"] = static_cast<double>(each.status.period) * 1e-3;
        agent["loop"] = each.loop;
        agent["states"] = countsJson(each.states, State{});
        agent["qualities"] = countsJson(each.qualities, Quality{});
        agents.push_back(std::move(agent));
    }
    for (const TopTask& each : frame.tasks) {
        tasks.push_back({{"path", each.path}, {"agent", each.agent}, {"time_us", each.time}});
    }
    for (const TopFault& each : frame.faults) {
        faults.push_back(
            {{"path", each.path}, {"agent", each.agent}, {"code", each.code}, {"text", each.text}});
    }
    for (const auto& each : frame.contested) contested.push_back(contestedJson(each));
    for (const comms::AgentEvent& each : frame.events) events.push_back(eventJson(each));
    return {{"time", common::utcText(frame.time)},
            {"agents", agents},
            {"tasks", tasks},
            {"faults", faults},
            {"contested", contested},
            {"events", events}};
}

}  // namespace cortex::cli
