// SPDX-License-Identifier: Apache-2.0
#include "widgets/unit_menu.hpp"

#include "model/value_text.hpp"

#include <QActionGroup>
#include <QCoreApplication>
#include <QMenu>
#include <string>
#include <utility>

namespace cortex::gui {

namespace {

QString inWords(const char* text) { return QCoreApplication::translate("Units", text); }

void addChoices(QMenu& menu, std::size_t quantity, const UnitsOfView& view) {
    const UnitQuantity& of = unitQuantities()[quantity];
    auto* choices = new QActionGroup{&menu};
    const ShownUnits now = view.now();
    const auto add = [&](const QString& text, const std::string& unit) {
        QAction* choice = menu.addAction(text, &menu, [view, quantity, unit] {
            ShownUnits units = view.now();
            units.choose(quantity, unit);
            view.choose(units);
        });
        choice->setCheckable(true);
        choice->setChecked(now.chosen(quantity) == unit);
        choices->addAction(choice);
    };
    add(inWords("%1 as in the model").arg(inWords(of.name)), {});
    for (const char* unit : of.units) {
        const QString text =
            unitText(unit) == QLatin1String{unit}
                ? unitText(unit)
                : QStringLiteral("%1 (%2)").arg(unitText(unit), QLatin1String{unit});
        add(inWords("%1 in %2").arg(inWords(of.name), text), unit);
    }
}

}  // namespace

void fillUnitMenu(QMenu& menu, std::function<UnitsOfView()> view) {
    QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu, view = std::move(view)] {
        menu.clear();
        const UnitsOfView of = view();
        if (!of.now) {
            menu.addAction(inWords("This view shows no units"))->setEnabled(false);
            return;
        }
        for (std::size_t i = 0; i < unitQuantities().size(); ++i) {
            if (i > 0) menu.addSeparator();
            addChoices(menu, i, of);
        }
    });
}

}  // namespace cortex::gui
