// SPDX-License-Identifier: Apache-2.0
#include "summary.hpp"

#include "cortex/core/printable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace cortex::toolkit {
namespace {

std::string fixed(double number, int decimals) {
    std::array<char, 400> text{};
    const auto end =
        std::to_chars(text.begin(), text.end(), number, std::chars_format::fixed, decimals);
    return {text.data(), end.ptr};
}

// Decimals that a format such as "%.3f" asks for; 3 without one.
int decimalsOf(const std::string& format) {
    const std::size_t dot = format.find('.');
    int decimals = 3;
    if (dot != std::string::npos) {
        std::from_chars(format.data() + dot + 1, format.data() + format.size(), decimals);
    }
    return std::clamp(decimals, 0, 9);
}

std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, text.size()), ' ');
}

std::string textOf(const DataItem& item, const Value& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (numbers != nullptr && numbers->size() == 1) {
        return fixed(numbers->front(), decimalsOf(item.format));
    }
    if (const auto* ints = std::get_if<std::vector<std::int64_t>>(&value);
        ints && ints->size() == 1) {
        if (const auto label = item.labels.find(ints->front()); label != item.labels.end()) {
            return label->second;
        }
    }
    return printable(toText(value));
}

std::string monitorTable(const Image& image, std::uint32_t index) {
    const SimplexInfo& info = image.structure().simplexes[index];
    const Type* active = image.structure().types->find("Active");
    std::string text = "\n" + info.path + " (" + info.layout->type->name + ")\n";
    std::vector<const ItemLayout*> items;
    for (const ItemLayout& layout : info.layout->items) {
        const bool framework = active != nullptr && active->findData(layout.item->name) != nullptr;
        if (!framework && !layout.item->constant) items.push_back(&layout);
    }
    for (const ItemLayout* layout : items) {
        const DataItem& item = *layout->item;
        text += "  " + left(item.name, 16) + right(textOf(item, image.value(index, *layout)), 12) +
                " " + left(item.unit, 6) + item.description + "\n";
    }
    return text;
}

}  // namespace

std::string statusLine(const Image& image, const std::string& cluster) {
    const std::string path = "/" + cluster;
    std::array<int, stateCount> states{};
    for (std::uint32_t i = 0; i < image.structure().simplexes.size(); ++i) {
        const SimplexInfo& info = image.structure().simplexes[i];
        if (info.role != Role::Active || info.remote) continue;
        const ItemLayout* layout = info.layout->find("state");
        if (layout == nullptr) continue;
        const auto value = std::get<std::vector<std::int64_t>>(image.value(i, *layout)).front();
        if (value >= 0 && value < stateCount) ++states[static_cast<std::size_t>(value)];
    }
    std::string text = fixed(static_cast<double>(image.nominalTime()) * 1e-9, 0) + " s  cycle " +
                       toText(image.cycle()) + "  duty " +
                       fixed(image.get<double>(path, "dutyCycleMean"), 2) + " %  overflows " +
                       toText(image.get<std::int64_t>(path, "overflowCount"));
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] == 0) continue;
        text += "  " + std::string{name(static_cast<State>(i))} + " " + std::to_string(states[i]);
    }
    return text;
}

std::string metricsTable(const Image& image, const std::string& cluster) {
    using Row = std::array<const char*, 3>;  // title, unit, item
    constexpr std::array rows{Row{"cycle duration", "us", "cycleDuration"},
                              Row{"jitter", "us", "jitter"}, Row{"lateness", "us", "lateness"},
                              Row{"duty cycle", "%", "dutyCycle"},
                              Row{"command latency", "us", "commandLatency"}};
    constexpr std::array columns{"Last", "Mean", "P50", "P99", "P999", "Max"};
    constexpr std::array titles{"last", "mean", "p50", "p99", "p99.9", "max"};
    constexpr std::array counts{
        Row{"overflows", "", "overflowCount"},    Row{"commands", "", "commandCount"},
        Row{"rejected", "", "rejectedCount"},     Row{"conflicts", "", "conflictCount"},
        Row{"limited demands", "", "limitCount"}, Row{"dropped events", "", "eventsDropped"}};
    const std::string path = "/" + cluster;

    std::string text = "\n" + path + ": " + toText(image.cycle()) + " cycles in " +
                       fixed(static_cast<double>(image.nominalTime()) * 1e-9, 1) + " s on " +
                       toText(image.get<std::int64_t>(path, "threads")) + " thread(s)\n" +
                       left("", 22);
    for (const char* title : titles) text += right(title, 11);
    text += "\n";
    for (const auto& [title, unit, item] : rows) {
        const auto figure = [&, name = std::string{item}](std::string_view column) {
            return image.get<double>(path, name + std::string{column});
        };
        const bool any = figure("Max") > 0, ranked = figure("P999") > 0;  // 0: not computed yet
        text += "  " + left(title, 16) + left(unit, 4);
        for (const std::string_view column : columns) {
            const bool known = column.starts_with('P') ? ranked : any;
            text += right(known ? fixed(figure(column), 2) : "-", 11);
        }
        text += "\n";
    }
    for (const auto& [title, unit, item] : counts) {
        text += countLine(title, static_cast<std::uint64_t>(image.get<std::int64_t>(path, item)));
    }
    return text;
}

std::string countLine(const std::string& title, std::uint64_t count) {
    return "  " + left(title, 20) + right(std::to_string(count), 11) + "\n";
}

MissingLinks missingLinks(const AgentRuntime& agent) {
    const Structure& structure = agent.structure();
    MissingLinks missing;
    for (const Edge& edge : structure.edges) {
        const bool needed = structure.simplexes[edge.target].remote && edge.rule->min > 0;
        if (needed && !agent.isLinked(edge.target))
            missing.emplace(structure.simplexes[edge.target].path,
                            structure.simplexes[edge.owner].path);
    }
    return missing;
}

std::string faultLines(const Image& image) {
    std::string text;
    const Structure& structure = image.structure();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (info.remote || !info.layout->type->isA("Active")) continue;
        if (image.get<std::int64_t>(info.path, "state") != static_cast<int>(State::Fault)) continue;
        const auto why = image.get<std::string_view>(info.path, "faultText");
        text += info.path + " is in Fault: " + printable(why) + "\n";
    }
    return text.empty() ? text : "\n" + text;
}

std::string monitorTables(const Image& image) {
    std::string text;
    const Structure& structure = image.structure();
    for (std::uint32_t i = 0; i < structure.simplexes.size(); ++i) {
        const SimplexInfo& info = structure.simplexes[i];
        if (!info.remote && info.layout->type->isA("Monitor")) text += monitorTable(image, i);
    }
    return text;
}

}  // namespace cortex::toolkit
