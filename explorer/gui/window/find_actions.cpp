// SPDX-License-Identifier: Apache-2.0
#include "window/find_actions.hpp"

#include <QMenu>
#include <QPointer>

namespace cortex::gui {

std::vector<FindAction> actionsOf(QMenu& menu) {
    Q_EMIT menu.aboutToShow();  // then entries say what is true now
    std::vector<FindAction> all;
    for (QAction* each : menu.actions()) {
        if (each->menu() != nullptr && each->menu()->property(foundToo).toBool()) {
            for (FindAction& inner : actionsOf(*each->menu())) {
                inner.text = each->text() + QStringLiteral(": ") + inner.text;
                all.push_back(std::move(inner));
            }
        }
        if (each->isSeparator() || each->menu() != nullptr || !each->isEnabled()) continue;
        if (each->property(onlyInMenu).toBool()) continue;
        const QString text = QString{each->text()}.replace(QLatin1String{"&&"}, QLatin1String{"&"});
        const QString between = QStringLiteral("  ");  // an entry and its keys
        all.push_back({text.section(between, 0, 0), text.section(between, 1),
                       [action = QPointer{each}] {
                           if (action) action->trigger();
                       },
                       each->property(discardsSomething).toBool()});
    }
    return all;
}

}  // namespace cortex::gui
