// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/path.hpp"
#include "cortex/core/record.hpp"

#include "live/control.hpp"
#include "live/live_json.hpp"
#include "live/live_values.hpp"
#include "live/progress.hpp"
#include "text/interrupts.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>

namespace cortex::cli {
namespace {

Exit exitOf(Outcome outcome) {
    if (outcome == Outcome::Done) return Yes;
    if (outcome == Outcome::Running) return StillRunning;
    return outcome == Outcome::Unknown ? NotFound : No;
}

const CommandTable::Entry& entryOf(const CommandTable& table, const FoundSimplex& simplex,
                                   const std::string& command) {
    const std::uint32_t index = table.find(command);
    if (index != CommandTable::none) return table.entries[index];
    if (command == "set") {
        throw Failure{Usage, "nothing of " + simplex.info().path + " (" + simplex.type().name +
                                 ") can be set"};
    }
    std::vector<std::string> valid;
    for (const auto& each : table.entries) valid.emplace_back(each.name);
    const std::string nearest = nearestNames(command, valid);
    const std::string all = valid.empty() ? "there is none" : "there are " + joined(valid);
    throw Failure{NotFound, simplex.info().path + " (" + simplex.type().name +
                                ") has no command '" + command + "'; " +
                                (nearest.empty() ? all : nearest)};
}

std::string whatItIs(const FoundSimplex& simplex, const DataItem& item) {
    if (item.constant) return "a constant of its type";
    const Role role = simplex.info().role;
    if (role == Role::Observation) return "an observation";
    if (role == Role::Modification) return "a demand, which another simplex writes";
    return "written by the simplex itself";
}

// That `set` cannot set an item of the simplex, before the network is asked.
void checkSettable(const FoundSimplex& simplex, const CommandTable& table,
                   const std::vector<std::string>& arguments) {
    for (const std::string& each : arguments) {
        const std::string name = each.substr(0, each.find('='));
        const ItemLayout* found = simplex.info().layout->find(name);
        const auto isIt = [&](const DataItem* item) { return item->name == name; };
        if (found == nullptr || std::ranges::any_of(table.settable, isIt)) continue;
        std::vector<std::string> settable;
        for (const DataItem* item : table.settable) settable.push_back(item->name);
        const std::string others = settable.empty()
                                       ? "nothing of " + simplex.info().path + " is"
                                       : "of " + simplex.info().path + " are: " + joined(settable);
        throw Failure{Usage, name + " is " + whatItIs(simplex, *found->item) +
                                 "; it is not settable; " + others};
    }
}

double microseconds(const comms::CommandAnswer& answer) {
    return static_cast<double>(answer.latency.count()) * 1e-3;
}

Json answerJson(const comms::CommandAnswer& answer, const RecordLayout& layout) {
    Json response = Json::object();
    for (const ItemLayout& each : layout.items) {
        const auto found = answer.response.find(each.item->name);
        if (found == answer.response.end()) continue;
        response[each.item->name] = valueJson(*each.item, found->second);
    }
    const std::string code = name(answer.reason);
    const std::string reason =
        answer.why.empty() || answer.reason == Reason::None ? answer.why : code + ": " + answer.why;
    return {{"outcome", name(answer.outcome)},
            {"reason", reason},
            {"response", response},
            {"latency_us", microseconds(answer)}};
}

// Why nothing has come, as far as the presence of the agent and its activity tell.
void explainSilence(comms::CommandAnswer& answer, const Live& live, const std::string& agent,
                    std::optional<long> percent) {
    const comms::AgentStatus status = live.statusOf(agent);
    const std::string& standstill = status.standstill;
    if (status.state == "lost") {
        answer.why = agent + " is not heard: " + answer.why;
    } else if (!standstill.empty()) {
        answer.why =
            "the loop of " + agent + " " + standstill + ", so nothing is answered; " + answer.why;
    } else if (percent) {
        answer.outcome = Outcome::Running;
        answer.why =
            "still running at " + std::to_string(*percent) + " %, not waited for any longer";
    }
}

void printAnswer(const comms::CommandAnswer& answer, const RecordLayout& layout) {
    std::cout << printable(answer.text()) << '\n';
    Columns columns{2};
    for (const ItemLayout& each : layout.items) {
        const auto found = answer.response.find(each.item->name);
        if (found == answer.response.end()) continue;
        columns.add({each.item->name, valueText(*each.item, found->second), each.item->unit});
    }
    columns.print(std::cout);
}

// That something stands at or below a prefix that is a parameter of the agent's own simplex.
void checkPrefixParameter(const FoundSimplex& simplex, const comms::Mirror::Arguments& arguments) {
    const auto given = arguments.find("prefix");
    if (given == arguments.end() || simplex.info().path != "/" + simplex.agent) return;
    const auto* texts = std::get_if<std::vector<std::string>>(&given->second);
    if (texts == nullptr || texts->size() != 1) return;
    checkPrefix(texts->front());
    std::vector<std::string> paths;
    for (const SimplexInfo& each : simplex.structure->simplexes) {
        if (!each.remote && isAtOrBelow(each.path, texts->front())) return;
        if (!each.remote) paths.push_back(each.path);
    }
    const std::string nearest = nearestNames(texts->front(), paths);
    throw Failure{NotFound, simplex.agent + " has nothing at or below " + texts->front() +
                                (nearest.empty() ? "" : "; " + nearest)};
}

}  // namespace

// Finding the agent and its answer share one time to wait. Control is released on every way out.
Exit callCommand(const CallOptions& options) {
    std::optional<Interrupts> interrupts;
    if (options.take) interrupts.emplace();
    Live live{options.network};
    live.actFor(options.person);
    const FoundSimplex simplex = live.find(options.path);
    const CommandTable table = commandTable(simplex.type());
    if (options.command == "set") checkSettable(simplex, table, options.arguments);
    const CommandTable::Entry& entry = entryOf(table, simplex, options.command);
    const auto arguments =
        parseArguments("command '" + options.command + "'", entry.request, options.arguments);
    checkPrefixParameter(simplex, arguments);
    const std::string missing = missingArguments(entry, arguments);
    if (!missing.empty()) throw Failure{Usage, missing};
    std::optional<BriefControl> control;
    const auto prefix = controlledBy(simplex, entry, arguments);
    if (options.take && prefix) control.emplace(live, simplex.agent, *prefix);
    const std::chrono::milliseconds left = live.left();
    const auto sent = std::chrono::steady_clock::now();
    std::optional<Progress> progress;
    progress.emplace(live, simplex, entry);
    comms::CommandAnswer answer =
        live.call(options.path, options.command, arguments, [&] { progress->look(); });
    if (answer.outcome == Outcome::Unknown) {
        answer.why += " (finding the agent left " + std::to_string(left.count()) + " of the " +
                      std::to_string(live.timeout().count()) + " ms of --timeout)";
        explainSilence(answer, live, simplex.agent, progress->percent());
    }
    progress.reset();
    const auto took = std::chrono::steady_clock::now() - sent;
    if (options.json) {
        Json shown = answerJson(answer, entry.response);
        if (const auto contest = live.contestOf(options.path)) {
            shown["contested"] = contestedJson(*contest);
        }
        shown["round_trip_us"] = std::chrono::duration<double, std::micro>(took).count();
        print(shown);
    } else {
        printAnswer(answer, entry.response);
        if (answer.reason == Reason::Authority && !options.take) std::cerr << authorityHint(answer);
    }
    return exitOf(answer.outcome);
}

std::string howToSet(const std::string& path, const std::vector<std::string>& arguments) {
    const std::size_t dot = path.find('.');
    const std::string item = dot == std::string::npos ? "ITEM" : path.substr(dot + 1);
    const bool hasValue = item.find('=') != std::string::npos;
    const std::string value = arguments.size() == 1 && !hasValue ? arguments.front() : "VALUE";
    return "the path and the items are apart: cortex set " + path.substr(0, dot) + " " + item +
           (hasValue ? "" : "=" + value);
}

Exit setItems(const CallOptions& options) {
    if (options.path.find('.') != std::string::npos)
        throw Failure{Usage, howToSet(options.path, options.arguments)};
    CallOptions call = options;
    call.command = "set";
    return callCommand(call);
}

}  // namespace cortex::cli
