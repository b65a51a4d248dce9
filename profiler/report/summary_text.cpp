// SPDX-License-Identifier: Apache-2.0
#include "report/summary_text.hpp"

#include "report/quantity_text.hpp"
#include "report/text_columns.hpp"

namespace cortex::profiler {
namespace {

std::string listed(const std::vector<std::string>& entries, std::size_t width) {
    std::string text;
    for (const std::string& entry : entries) {
        std::string before = "- ";
        for (const std::string& line :
             wrappedText(printable(entry), width - std::min<std::size_t>(width, 2))) {
            text += before + line + "\n";
            before = "  ";
        }
    }
    return text;
}

}  // namespace

std::string summaryText(const Results& results, std::size_t width) {
    std::vector<std::vector<std::string>> rows;
    for (const Quantity& each : results.quantities) {
        const std::optional<bool> reached = met(each);
        rows.push_back({each.what, valueText(each), baselineText(each), ratioText(each),
                        aimText(each), reached ? (*reached ? "met" : "NOT met") : "", each.paper});
    }
    std::string text;
    if (rows.empty()) {
        text = "Nothing was measured.\n";
    } else {
        text = textColumns({{"what", 9, false},
                            {"here", 8},
                            {"beside it", 3},
                            {"ratio", 6},
                            {"aim", 5},
                            {"", 7, false},
                            {"paper", 1, false}},
                           rows, width);
    }
    const Aims aims = aimsOf(results);
    if (aims.all > 0) {
        text += "\nAims met: " + std::to_string(aims.all - aims.missed.size()) + " of " +
                std::to_string(aims.all) + (aims.missed.empty() ? "\n" : "; not met:\n") +
                listed(aims.missed, width);
    }
    if (!results.complete) text += "\nNot complete: the run was stopped, or still goes on.\n";
    if (!results.notes.empty()) text += "\n" + listed(results.notes, width);
    return text;
}

}  // namespace cortex::profiler
