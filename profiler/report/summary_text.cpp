// SPDX-License-Identifier: Apache-2.0
#include "report/summary_text.hpp"

#include "report/quantity_text.hpp"
#include "text/plain_text.hpp"
#include "text/text_table.hpp"

namespace cortex::profiler {
namespace {

std::string listed(const std::string& heading, const std::vector<std::string>& entries,
                   std::size_t width) {
    if (entries.empty()) return {};
    std::string text = "\n" + heading + (heading.empty() ? "" : "\n");
    for (const std::string& entry : entries) {
        std::string before = "- ";
        for (const std::string& line :
             cli::wrapped(printable(entry), width - std::min<std::size_t>(width, 2))) {
            text += before + line + "\n";
            before = "  ";
        }
    }
    return text;
}

}  // namespace

std::string tableText(const cli::TextTable& table, std::size_t width) {
    std::string text;
    for (const cli::TextLine& line : table.lines(width)) {
        text += cli::rendered(line, cli::anyWidth, false) + "\n";
    }
    return text;
}

std::string summaryText(const Results& results, std::size_t width) {
    cli::TextTable table{{{"", "what", 9, 0, false, true},
                          {"", "here", 8},
                          {"", "beside it", 3},
                          {"", "ratio", 6},
                          {"", "aim", 5},
                          {"", "", 7, 0, false},
                          {"", "paper", 1, 0, false}}};
    std::string group;
    for (const Quantity& each : results.quantities) {
        if (each.group != group) {
            table.add({{""}});
            table.add({{(group = each.group) + ":"}});
        }
        table.add({{each.what},
                   {valueText(each)},
                   {baselineText(each)},
                   {ratioText(each)},
                   {aimText(each)},
                   {verdictText(each)},
                   {each.paper}});
    }
    std::string text =
        results.quantities.empty() ? "Nothing was measured.\n" : tableText(table, width);
    const Aims aims = aimsOf(results);
    if (aims.all > 0) {
        const std::size_t met = aims.all - aims.missed.size() - aims.notJudged.size();
        text += "\nAims met: " + std::to_string(met) + " of " + std::to_string(aims.all) + "\n" +
                listed("Missed:", aims.missed, width) +
                listed("Not judged, run it again:", aims.notJudged, width);
    }
    if (!results.complete) text += "\nNot complete: not everything was measured.\n";
    return text + listed("", results.notes, width);
}

}  // namespace cortex::profiler
