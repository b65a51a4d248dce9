// SPDX-License-Identifier: Apache-2.0
#include "model/item_text.hpp"

#include "model/value_text.hpp"

#include <QCoreApplication>
#include <QStringList>
#include <optional>
#include <variant>

namespace cortex::gui {

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
        case Safe::Kind::Stop:
            return itemText("safe: stops");
        case Safe::Kind::None:
            break;
    }
    return {};
}

QString limitsText(const DataItem& item) {
    const auto plain = [](const std::optional<Number>& limit) {
        const auto* whole = std::get_if<std::int64_t>(&*limit);
        QString number =
            whole != nullptr ? QString::number(*whole) : QString::number(*numberOf(limit), 'g', 12);
        return number.replace('-', QStringLiteral("−"));
    };
    const auto text = [&](const std::optional<Number>& limit) {
        return item.unit.empty() ? plain(limit) : plain(limit) + ' ' + unitText(item.unit);
    };
    if (item.min && item.max) return itemText("%1 to %2").arg(plain(item.min), text(item.max));
    if (item.min) return itemText("at least %1").arg(text(item.min));
    return item.max ? itemText("at most %1").arg(text(item.max)) : QString{};
}

QString labelsText(const DataItem& item) {
    QStringList labels;
    for (const auto& [number, label] : item.labels) {
        labels << QString::number(number) + ':' + QString::fromStdString(label);
    }
    return itemText("labels: %1").arg(labels.join(' '));
}

}  // namespace cortex::gui
