// SPDX-License-Identifier: Apache-2.0
#include "model/item_text.hpp"

#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QStringList>

namespace cortex::explorer {

namespace {

QString itemText(const char* text) { return QCoreApplication::translate("ItemModel", text); }

}  // namespace

QString remarkOf(const DataItem& item) {
    if (item.constant) return itemText("constant");
    if (item.measured) return itemText("measured");
    if (item.settable == StateSet::always()) return itemText("settable");
    if (!item.settable.empty())
        return itemText("set in %1").arg(QString::fromStdString(item.settable.text()));
    return {};
}

QString safeRemark(const DataItem& item) {
    switch (item.safe.kind) {
        case Safe::Kind::Given:
            return itemText("safe %1").arg(valueText(item, item.safe.value));
        case Safe::Kind::Hold:
            return itemText("safe: holds");
        case Safe::Kind::Observed:
            return itemText("safe: as observed");
        case Safe::Kind::None:
            break;
    }
    return {};
}

QString labelsText(const DataItem& item) {
    QStringList labels;
    for (const auto& [number, label] : item.labels) {
        labels << QString::number(number) + ':' + QString::fromStdString(label);
    }
    return itemText("labels: %1").arg(labels.join(' '));
}

}  // namespace cortex::explorer
