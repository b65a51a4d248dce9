// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/error.hpp"

#include "doctor/doctor.hpp"
#include "text/text_table.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>

namespace cortex::cli {
namespace {

using Level = Diagnosis::Level;

Look lookOf(Level level) {
    if (level == Level::Ok) return Look::Good;
    return level == Level::Warning ? Look::Warning : Look::Error;
}

std::size_t count(const Diagnoses& found, Level level) {
    return static_cast<std::size_t>(std::ranges::count(found, level, &Diagnosis::level));
}

void printAll(const Diagnoses& found) {
    const bool colour = coloured(Stream::Output);
    const auto padded = [](std::string text, std::size_t width) {
        text.resize(std::max(width, text.size()), ' ');
        return text;
    };
    for (const Diagnosis& each : found) {
        const TextLine line{{padded(name(each.level), 9), lookOf(each.level)},
                            {padded(each.subject, 15)},
                            {each.message + (each.remedy.empty() ? "" : "; " + each.remedy)}};
        std::cout << rendered(line, anyWidth, colour) << '\n';
    }
    std::cout << plural(count(found, Level::Error), "error") << ", "
              << plural(count(found, Level::Warning), "warning") << '\n';
}

}  // namespace

const char* name(Level level) {
    if (level == Level::Ok) return "ok";
    return level == Level::Warning ? "warning" : "error";
}

Exit examine(const LiveOptions& options) {
    Diagnoses found;
    examineMachine(found);
    examineNetwork(domainOf(options.network), found);
    Arrivals arrivals;
    try {
        Live live{options.network};
        live.listen([&](const comms::AgentEvent& event) { arrivals.push(event); });
        examineAgents(live, arrivals, found);
    } catch (const Failure& failure) {
        found.push_back({Level::Error, "network", failure.what(), ""});
    } catch (const Error& error) {
        found.push_back({Level::Error, "network", error.what(), ""});
    }
    if (options.json) {
        Json list = Json::array();
        for (const Diagnosis& each : found) {
            list.push_back({{"level", name(each.level)},
                            {"subject", each.subject},
                            {"message", each.message},
                            {"remedy", each.remedy}});
        }
        print({{"findings", list}});
    } else {
        printAll(found);
    }
    return count(found, Level::Error) == 0 ? Yes : No;
}

}  // namespace cortex::cli
