// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/labelled_value.hpp"

#include "common/shell_line.hpp"
#include "live/live_values.hpp"
#include "live/safe_demand.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

namespace cortex::cli {
namespace {

struct Line {
    FoundSimplex simplex;
    std::optional<State> state;
    Quality quality = Quality::Lost;
    StaleDemand demand{};
    std::int64_t wrong = 0;  // values that are out of their range
};

// What is listed, and whoever writes a demand of it: their states tell why it is stale.
std::vector<std::string> viewedFor(const Live& live, const std::string& prefix) {
    std::set<std::string> paths{prefix};
    for (const FoundSimplex& each : live.below(prefix)) {
        if (each.info().role != Role::Modification) continue;
        for (const std::uint32_t writer : each.info().writers) {
            paths.insert(each.structure->simplexes[writer].path);
        }
    }
    return {paths.begin(), paths.end()};
}

std::int64_t wrongValues(const comms::AgentImage& image, const FoundSimplex& simplex) {
    if (!isLive(image, simplex.index)) return 0;
    return std::ranges::count_if(simplex.info().layout->items, [&](const ItemLayout& each) {
        return !outsideText(*each.item, image->value(simplex.index, each)).empty();
    });
}

std::vector<Line> linesOf(Live& live, const std::vector<FoundSimplex>& simplexes) {
    std::map<std::string, comms::AgentImage> images;
    std::vector<Line> lines;
    for (const FoundSimplex& each : simplexes) {
        auto found = images.find(each.agent);
        if (found == images.end()) {
            found = images.emplace(each.agent, live.mirror().image(each.agent)).first;
        }
        Line line{each, {}, Quality::Lost, {}, 0};
        const comms::AgentImage& image = found->second;
        if (image && &image->structure() == each.structure.get()) {
            if (isLive(image, each.index)) line.state = stateOf(image, each.index);
            line.quality = image->state(each.index).quality;
            line.demand = safeBecause(each.index, image->state(each.index), image);
            line.wrong = wrongValues(image, each);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

Json lineJson(const Line& line) {
    return {{"path", line.simplex.info().path},
            {"type", line.simplex.type().name},
            {"role", name(line.simplex.info().role)},
            {"agent", line.simplex.agent},
            {"state", line.state ? Json(name(*line.state)) : Json()},
            {"quality", name(line.quality)},
            {"safe", safeJson(line.demand)},
            {"wrong", line.wrong}};
}

std::string qualityOf(const Line& line) {
    std::string text = qualityText(line.quality, line.demand);
    if (line.wrong > 0) {
        text += ", " + std::to_string(line.wrong) + (line.wrong == 1 ? " value" : " values") +
                " out of range";
    }
    return text;
}

void printLines(const std::vector<Line>& lines) {
    Columns columns{0};
    for (const Line& each : lines) {
        columns.add({each.simplex.info().path, each.simplex.type().name,
                     name(each.simplex.info().role), each.simplex.agent,
                     each.state ? name(*each.state) : "-", qualityOf(each)});
    }
    columns.print(std::cout);
}

// Of agents of which nothing that is listed runs: with what starts it.
void printResting(const Live& live, const std::vector<Line>& lines, const ListOptions& options) {
    std::map<std::string, std::size_t> resting;
    std::set<std::string> others;  // agents of which something runs, or may run
    for (const Line& each : lines) {
        if (each.simplex.info().role != Role::Active || !each.simplex.type().isA("Active"))
            continue;
        if (each.state == State::Standby)
            ++resting[each.simplex.agent];
        else
            others.insert(each.simplex.agent);
    }
    comms::NetworkOptions network = optionsOf(options.network);
    network.domain = live.domain();
    const std::string below = options.prefix == "/" ? "" : " at or below " + options.prefix;
    for (const auto& [agent, count] : resting) {
        if (others.contains(agent)) continue;
        const std::string line = common::shellLine(
            {"call", "/" + agent, "startup", "prefix=" + options.prefix}, network);
        std::cerr << "cortex: "
                  << printable("nothing of " + agent + below +
                               " is started: " + plural(count, "active simplex") +
                               (count == 1 ? " is in Standby; to start it: "
                                           : " are in Standby; to start them: ") +
                               line)
                  << '\n';
    }
}

}  // namespace

// States and qualities are values: they are viewed for as long as it takes to get them once.
Exit listSimplexes(const ListOptions& options) {
    checkPrefix(options.prefix);
    Live live{options.network};
    live.view({options.prefix}, 100);
    live.waitForAll(options.prefix);
    if (options.prefix != "/") live.view(viewedFor(live, options.prefix), 100);
    live.waitForValues();
    const std::string lacking = live.incomplete();
    if (options.json && !lacking.empty()) throw Failure{NotFound, lacking};
    live.printWarnings();
    const auto lines = linesOf(live, live.below(options.prefix));
    if (lines.empty()) live.failIfNothingIsAt(options.prefix);
    if (options.json) {
        Json list = Json::array();
        for (const Line& each : lines) list.push_back(lineJson(each));
        print(list);
        return Yes;
    }
    printLines(lines);
    printResting(live, lines, options);
    if (!lacking.empty()) throw Failure{NotFound, lacking};
    return Yes;
}

}  // namespace cortex::cli
