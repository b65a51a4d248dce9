// SPDX-License-Identifier: Apache-2.0
#include "widgets/item_drag.hpp"

#include <QStringList>

namespace cortex::gui {

namespace {

const QString format = QStringLiteral("application/x-cortex-items");

}  // namespace

QMimeData* mimeOf(const std::vector<RecordedItem>& items) {
    QStringList lines;
    for (const RecordedItem& each : items) lines.append(QString::fromStdString(textOf(each)));
    auto* data = new QMimeData;
    const QString text = lines.join('\n');
    data->setText(text);
    data->setData(format, text.toUtf8());
    return data;
}

std::vector<RecordedItem> itemsIn(const QMimeData* data) {
    std::vector<RecordedItem> items;
    if (data == nullptr || !data->hasFormat(format)) return items;
    for (const QString& line : QString::fromUtf8(data->data(format)).split('\n')) {
        if (const auto item = recordedItem(line.toStdString())) items.push_back(*item);
    }
    return items;
}

}  // namespace cortex::gui
