// SPDX-License-Identifier: Apache-2.0
#include "views/type_page.hpp"

#include "widgets/rows.hpp"

namespace cortex::gui {

namespace {

QString multiplicity(const Rule& rule) {
    const QString most = rule.max == Rule::many ? QStringLiteral("∞") : QString::number(rule.max);
    return TypePage::tr("%1, %2 to %3 %4")
        .arg(QLatin1String{name(rule.direction)})
        .arg(rule.min)
        .arg(most, QString::fromStdString(rule.target));
}

void add(QTreeWidgetItem* parent, const std::string& name, const QString& what,
         const std::string& definedBy, const std::string& description) {
    new QTreeWidgetItem{parent,
                        {QString::fromStdString(name), what, QString::fromStdString(definedBy),
                         QString::fromStdString(description)}};
}

}  // namespace

TypePage::TypePage(QWidget* parent) : QTreeWidget{parent} {
    setUpRows(*this);
    setAccessibleName(tr("Type"));
    setHeaderLabels({tr("Name"), tr("What"), tr("From"), tr("Description")});
}

void TypePage::show(const Type& type, const TypeModel& types) {
    clear();
    auto* itself = addGroup(*this, tr("Type"));
    add(itself, type.name, tr("version %1").arg(QString::fromStdString(type.version)), type.name,
        type.description);
    auto* ancestors = addGroup(*this, tr("Ancestors"));
    for (const std::string& each : type.ancestors) {
        const Type* ancestor = types.find(each);
        add(ancestors, each, {}, {}, ancestor != nullptr ? ancestor->description : std::string{});
    }
    auto* items = addGroup(*this, tr("Items"));
    for (const DataItem& item : type.data) {
        add(items, item.name, QLatin1String{name(item.kind)}, item.definedBy, item.description);
    }
    auto* commands = addGroup(*this, tr("Commands"));
    for (const Command& command : type.commands) {
        add(commands, command.name, QString::fromStdString(command.available.text()),
            command.definedBy, command.description);
    }
    auto* rules = addGroup(*this, tr("Rules"));
    for (const Rule& rule : type.rules) {
        add(rules, rule.name, multiplicity(rule), rule.definedBy, rule.description);
    }
    tellWhole(*this);
    expandAll();
    setWidths(*this, {56.0, 72.0, 44.0});
}

}  // namespace cortex::gui
