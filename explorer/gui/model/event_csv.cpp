// SPDX-License-Identifier: Apache-2.0
#include "model/event_csv.hpp"

#include "common/utc_text.hpp"
#include "model/plain_text.hpp"
#include "model/whole_file.hpp"

namespace cortex::gui {

namespace {

QString csvField(const std::string& text) {
    QString field = plainText(text);
    if (!field.contains(',') && !field.contains('"') && !field.contains(' ')) return field;
    return '"' + field.replace('"', QStringLiteral("\"\"")) + '"';
}

QString csvLine(const comms::AgentEvent& event) {
    return QStringList{QString::fromStdString(common::utcText(event.wallClock)),
                       csvField(event.agent),
                       QString::number(event.number),
                       QString::number(event.cycle),
                       QString::fromLatin1(name(event.severity)),
                       csvField(event.kind),
                       csvField(event.path),
                       csvField(event.text)}
               .join(',') +
           '\n';
}

}  // namespace

QString eventsCsv(const EventFilter& events) {
    QString text = QStringLiteral("time,agent,number,cycle,severity,kind,path,text\n");
    for (std::size_t i = 0; i < events.rows(); ++i) {
        const EventRow& row = events.shownAt(i);
        text += csvLine(row.event);
        for (const comms::AgentEvent& each : row.others) text += csvLine(each);
    }
    return text;
}

QString writeEvents(const EventFilter& events, const QString& file) {
    return writeWholeFile(file, eventsCsv(events).toUtf8());
}

}  // namespace cortex::gui
