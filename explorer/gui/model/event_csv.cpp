// SPDX-License-Identifier: Apache-2.0
#include "model/event_csv.hpp"

#include "common/csv_cell.hpp"
#include "common/utc_text.hpp"
#include "model/whole_file.hpp"

namespace cortex::gui {

namespace {

using common::csvCell;

std::string csvLine(const comms::AgentEvent& event) {
    return common::utcText(event.wallClock) + ',' + csvCell(event.agent) + ',' +
           std::to_string(event.number) + ',' + std::to_string(event.cycle) + ',' +
           name(event.severity) + ',' + csvCell(event.kind) + ',' + csvCell(event.path) + ',' +
           csvCell(event.text) + '\n';
}

}  // namespace

std::string eventsCsv(const EventFilter& events) {
    std::string text = "time,agent,number,cycle,severity,kind,path,text\n";
    for (std::size_t i = 0; i < events.rows(); ++i) {
        const EventRow& row = events.shownAt(i);
        text += csvLine(row.event);
        for (const comms::AgentEvent& each : row.others) text += csvLine(each);
    }
    return text;
}

QString writeEvents(const EventFilter& events, const QString& file) {
    return writeWholeFile(file, QByteArray::fromStdString(eventsCsv(events)));
}

}  // namespace cortex::gui
