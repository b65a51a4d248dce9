// SPDX-License-Identifier: Apache-2.0
#include "views/command_list.hpp"

#include "model/value_text.hpp"
#include "widgets/rows.hpp"

namespace cortex::explorer {

namespace {

QString rangeText(const DataItem& item) {
    const auto bound = [&](const std::optional<Number>& number, const QString& none) {
        return number ? numberText(item, *numberOf(number)) : none;
    };
    if (!item.labels.empty()) {
        QStringList labels;
        for (const auto& [number, label] : item.labels) labels << QString::fromStdString(label);
        return labels.join(QStringLiteral(", "));
    }
    if (!item.min && !item.max) return {};
    return CommandList::tr("%1 to %2")
        .arg(bound(item.min, QStringLiteral("−∞")), bound(item.max, QStringLiteral("∞")));
}

QString kindText(const DataItem& item) {
    const QString kind = QLatin1String{name(item.kind)};
    return item.length == 1 ? kind : QStringLiteral("%1 × %2").arg(item.length).arg(kind);
}

void add(QTreeWidgetItem* command, const DataItem& item, bool given) {
    const QString fallback = item.hasDefault ? valueText(item, item.initial) : QString{};
    new QTreeWidgetItem{command,
                        {QString::fromStdString(item.name),
                         given ? CommandList::tr("gives") : CommandList::tr("takes"),
                         kindText(item), unitText(item.unit), rangeText(item),
                         given             ? QString{}
                         : item.hasDefault ? fallback
                                           : CommandList::tr("required"),
                         QString::fromStdString(item.description)}};
}

}  // namespace

CommandList::CommandList(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setAccessibleName(tr("Commands"));
    setHeaderLabels({tr("Command"), tr("Available"), tr("Kind"), tr("Unit"), tr("Range"),
                     tr("Default"), tr("Description")});
}

void CommandList::show(const Type& type) {
    clear();
    for (const Command& command : type.commands) {
        QString kind = command.isLong ? tr("long") : QString{};
        auto* item = new QTreeWidgetItem{this,
                                         {QString::fromStdString(command.name),
                                          QString::fromStdString(command.available.text()),
                                          kind,
                                          {},
                                          {},
                                          {},
                                          QString::fromStdString(command.description)}};
        item->setFont(0, Look::font(TextSize::Text, true));
        for (const DataItem& each : command.request) add(item, each, false);
        for (const DataItem& each : command.response) add(item, each, true);
    }
    expandAll();
    setWidths(*this, {44.0, 36.0, 24.0, 14.0, 36.0, 24.0});
}

}  // namespace cortex::explorer
