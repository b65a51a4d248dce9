// SPDX-License-Identifier: Apache-2.0
#include "live/top_text.hpp"

#include "live/contests.hpp"
#include "live/live_json.hpp"
#include "live/live_values.hpp"
#include "live/loop_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

namespace cortex::cli {
namespace {

using Lines = std::vector<TextLine>;

constexpr std::size_t fewestEvents = 3, mostFaults = 5, mostContests = 2, widestPath = 24;

std::string withDecimals(double number, int decimals) {
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                   std::chars_format::fixed, decimals);
    return {text.data(), end.ptr};
}

// Three digits or more, as wide for great numbers as for small ones.
std::string numberText(double number) {
    return withDecimals(number, number < 100 ? 2 : number < 10'000 ? 1 : 0);
}

Look lookOf(const std::string& state) {
    if (state == "running") return Look::Good;
    return state == "lost" ? Look::Error : Look::Warning;
}

Look lookOf(Severity severity) {
    constexpr std::array looks{Look::Plain, Look::Warning, Look::Error};
    return looks[static_cast<std::size_t>(severity)];
}

Span countCell(std::uint64_t count, Look look) {
    return {std::to_string(count), count > 0 ? look : Look::Plain};
}

std::string ageText(double seconds) {
    if (seconds < 1) return std::to_string(milliseconds(seconds)) + " ms";
    return withDecimals(seconds, 1) + " s";
}

TextTable agentTable(const TopFrame& frame, std::size_t count) {
    TextTable table{{{"", "agent", 9, 0, false},
                     {"", "state", 8, 0, false},
                     {"", "host", 3, 0, false},
                     {"", "age", 6, 6},
                     {"", "simplexes", 1},
                     {"", "rate", 4, 7},
                     {"", "cycle", 5, 8},
                     {"", "loss", 7},
                     {"", "security", 2, 0, false}}};
    for (std::size_t i = 0; i < count; ++i) {
        const comms::AgentStatus& each = frame.agents[i].status;
        table.add({{each.name, Look::Strong},
                   {each.state, lookOf(each.state)},
                   {each.host},
                   {ageText(each.age)},
                   {std::to_string(each.simplexes)},
                   {rateText(each), each.overloaded ? Look::Warning : Look::Plain},
                   {std::to_string(each.cycle)},
                   countCell(each.loss, Look::Warning),
                   {each.security.empty() ? "none" : each.security}});
    }
    return table;
}

struct LoopColumn {
    TableColumn column;
    const char* item;
};

const std::vector<LoopColumn>& loopColumns() {
    static const std::vector<LoopColumn> columns{
        {{"cycle us", "mean", 4, 6}, "cycleDurationMean"},
        {{"cycle us", "p99.9", 5, 6}, "cycleDurationP999"},
        {{"cycle us", "max", 8, 6}, "cycleDurationMax"},
        {{"late us", "mean", 3, 6}, "latenessMean"},
        {{"late us", "p99.9", 7, 6}, "latenessP999"},
        {{"late us", "max", 8, 6}, "latenessMax"},
        {{"duty %", "mean", 7, 6}, "dutyCycleMean"},
        {{"duty %", "p99.9", 3, 6}, "dutyCycleP999"},
        {{"duty %", "max", 6, 6}, "dutyCycleMax"},
        {{"command us", "p99.9", 1, 6}, "commandLatencyP999"},
        {{"command us", "max", 6, 6}, "commandLatencyMax"},
    };
    return columns;
}

TextTable loopTable(const TopFrame& frame, std::size_t count) {
    std::vector<TableColumn> columns{{"", "loop", 9, 0, false}};
    for (const LoopColumn& each : loopColumns()) columns.push_back(each.column);
    columns.push_back({"", "commands", 2});
    columns.push_back({"", "missed", 9});
    TextTable table{std::move(columns)};
    for (std::size_t i = 0; i < count; ++i) {
        const TopAgent& agent = frame.agents[i];
        TextLine cells{{agent.status.name, Look::Strong}};
        for (const LoopColumn& each : loopColumns()) {
            const auto number = agent.metric(each.item);
            cells.push_back({number ? numberText(*number) : "-"});
        }
        for (const char* item : {"commandCount", "overflowCount"}) {
            const auto number = agent.metric(item);
            cells.push_back({number ? withDecimals(*number, 0) : "-"});
        }
        if (agent.metric("overflowCount").value_or(0) > 0) cells.back().look = Look::Warning;
        table.add(std::move(cells));
    }
    return table;
}

TextTable stateTable(const TopFrame& frame, std::size_t count) {
    TextTable table{{{"", "states", 9, 0, false},
                     {"active simplexes", "Standby", 7},
                     {"active simplexes", "Starting", 5},
                     {"active simplexes", "Active", 8},
                     {"active simplexes", "Stopping", 4},
                     {"active simplexes", "Fault", 9},
                     {"quality of all simplexes", "good", 3},
                     {"quality of all simplexes", "stale", 2},
                     {"quality of all simplexes", "bad", 6},
                     {"quality of all simplexes", "lost", 6}}};
    constexpr std::array states{Look::Plain, Look::Warning, Look::Good, Look::Warning, Look::Error};
    constexpr std::array qualities{Look::Plain, Look::Plain, Look::Warning, Look::Error};
    for (std::size_t i = 0; i < count; ++i) {
        const TopAgent& agent = frame.agents[i];
        TextLine cells{{agent.status.name, Look::Strong}};
        for (std::size_t k = 0; k < states.size(); ++k) {
            cells.push_back(countCell(agent.states[k], states[k]));
        }
        for (std::size_t k = 0; k < qualities.size(); ++k) {
            cells.push_back(countCell(agent.qualities[k], qualities[k]));
        }
        table.add(std::move(cells));
    }
    return table;
}

Lines faultLines(const TopFrame& frame) {
    Lines lines;
    for (const TopAgent& each : frame.agents) {
        const std::string trouble = loopTrouble(each.status);
        if (trouble.empty()) continue;
        lines.push_back({{each.status.name, Look::Strong}, {" " + trouble, Look::Error}});
    }
    std::size_t told = 0;
    for (const TopFault& each : frame.faults) {
        if (lines.size() >= mostFaults) {
            lines.push_back(
                {{std::to_string(frame.faults.size() - told) + " more in Fault", Look::Error}});
            break;
        }
        ++told;
        lines.push_back({{"Fault " + std::to_string(each.code), Look::Error},
                         {"  " + each.path + "  ", Look::Strong},
                         {each.text}});
    }
    for (const std::string& each : contestLines(frame.contested, mostContests)) {
        lines.push_back({{each, Look::Warning}});
    }
    return lines;
}

// One line: "tasks us  /ik 412.0  /arm 15.20".
Lines taskLines(const TopFrame& frame) {
    if (frame.tasks.empty()) return {};
    TextLine line{{"tasks us", Look::Strong}};
    for (const TopTask& each : frame.tasks) {
        line.push_back({"  " + each.path + " ", Look::Plain});
        line.push_back({numberText(each.time), Look::Strong});
    }
    return {line};
}

std::string whereOf(const comms::AgentEvent& event) {
    return event.path.empty() ? event.agent : event.path;
}

TextLine eventLine(const comms::AgentEvent& event, std::size_t whereWidth) {
    std::string where = whereOf(event);
    where.resize(std::max(where.size(), whereWidth), ' ');
    const Look look = lookOf(event.severity);
    std::string severity = name(event.severity);
    severity.resize(7, ' ');
    return {{common::utcText(event.wallClock).substr(11, 12) + "  ", Look::Faint},
            {severity + "  ", look},
            {where, Look::Strong},
            {"  " + event.text, look}};
}

// The latest that have room below a heading.
Lines eventLines(const TopFrame& frame, std::size_t rows) {
    if (frame.events.empty()) return {{{"no events", Look::Strong}}};
    Lines lines{{{"events", Look::Strong}}};
    const std::size_t count = std::min(frame.events.size(), rows > 0 ? rows - 1 : 0);
    const auto events = std::span{frame.events}.last(count);
    std::size_t width = 0;
    for (const comms::AgentEvent& each : events) width = std::max(width, whereOf(each).size());
    for (const comms::AgentEvent& each : events) {
        lines.push_back(eventLine(each, std::min(width, widestPath)));
    }
    return lines;
}

void append(Lines& lines, Lines more) {
    for (TextLine& each : more) lines.push_back(std::move(each));
}

}  // namespace

// Rows are shared: as many agents in each of the three tables as leave room for faults and the
// latest events, which take the rest.
Lines topLines(const TopFrame& frame, const std::string& head, std::size_t width,
               std::size_t rows) {
    Lines lines{{{head, Look::Strong}}};
    const Lines faults = faultLines(frame);
    const bool airy = rows > 20;  // blank lines between
    const std::size_t fixed =
        1 + 5 + faults.size() + (frame.tasks.empty() ? 0 : 1) + (airy ? 4 : 0) + 2 + fewestEvents;
    const std::size_t agents = frame.agents.size();
    std::size_t count = std::min(agents, rows > fixed + 3 ? (rows - fixed) / 3 : 1);
    const auto space = [&] {
        if (airy) lines.emplace_back();
    };
    if (agents > 0) {
        space();
        append(lines, agentTable(frame, count).lines(width));
        if (count < agents) {
            lines.push_back({{plural(agents - count, "agent") + " more", Look::Faint}});
        }
        space();
        append(lines, loopTable(frame, count).lines(width));
        space();
        append(lines, stateTable(frame, count).lines(width));
        append(lines, taskLines(frame));
        append(lines, faults);
    }
    space();
    append(lines, eventLines(frame, rows > lines.size() ? rows - lines.size() : 0));
    lines.resize(std::min(lines.size(), rows));
    return lines;
}

}  // namespace cortex::cli
