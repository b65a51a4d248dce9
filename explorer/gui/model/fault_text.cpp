// SPDX-License-Identifier: Apache-2.0
#include "model/fault_text.hpp"

#include "common/cut_text.hpp"
#include "model/item_of.hpp"
#include "model/value_text.hpp"

#include <algorithm>
#include <string>

namespace cortex::gui {

namespace {

// What comes from outside is text: what cannot be printed is a blank.
QString inOneLine(const std::string& text) {
    QString result = QString::fromStdString(text);
    std::ranges::replace_if(result, [](QChar c) { return !c.isPrint(); }, QChar{' '});
    return result;
}

FaultText shown(const std::string& text, bool cut) {
    const QString line = inOneLine(text);
    return {cut ? line + QStringLiteral("…") : line, cut};
}

}  // namespace

QString faultCode(const AgentFrame& agent, std::uint32_t simplex) {
    const auto code = itemOf<std::int64_t>(agent, simplex, "faultCode");
    if (!code) return {};
    const ItemLayout* item = agent.structure->simplexes[simplex].layout->find("faultCode");
    return ' ' + elementText(*item->item, Value{std::vector<std::int64_t>{*code}}, 0);
}

FaultText faultText(const Frame& frame, Place place, const StateTimes& times) {
    const AgentFrame& agent = frame.agents[place.agent];
    const auto brief = itemOf<std::string>(agent, place.simplex, "faultText");
    const auto code = itemOf<std::int64_t>(agent, place.simplex, "faultCode");
    if (!brief || brief->empty()) return {};
    const std::string event = times.fault(frame, place);
    const std::string head = "fault " + std::to_string(code.value_or(0)) + ": ";
    if (event.starts_with(head + *brief)) {
        return shown(event.substr(head.size()), false);  // one that was cut says so itself
    }
    const ItemLayout* item = frame.info(place).layout->find("faultText");
    return shown(*brief, common::mayBeCut(*item->item, Value{std::vector{*brief}}));
}

}  // namespace cortex::gui
