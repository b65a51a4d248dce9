// SPDX-License-Identifier: Apache-2.0
#include "window/tree_menu.hpp"

#include "model/permission.hpp"

#include <QApplication>
#include <QClipboard>
#include <QCoreApplication>
#include <QMenu>

namespace cortex::gui {

namespace {

QString inWords(const char* text) { return QCoreApplication::translate("TreeMenu", text); }

}  // namespace

QMenu* makeTreeMenu(const std::string& path, bool isSimplex, const TreeActions& actions,
                    QWidget* parent) {
    auto* menu = new QMenu{parent};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const auto add = [&](const QString& text, const TreeActions::Action& action) {
        menu->addAction(text, menu, [action, path] { action(path); });
    };
    const QString scope = scopeText(path).replace('&', QLatin1String{"&&"});
    if (isSimplex) {
        add(inWords("Open"), actions.open);
        add(inWords("Open in a tab of its own"), actions.openTab);
        menu->addSeparator();
    }
    add(inWords("Take control of %1…").arg(scope), actions.takeControl);
    add(inWords("Start all of %1").arg(scope), actions.startAll);
    add(inWords("Stop all of %1").arg(scope), actions.stopAll);
    menu->addSeparator();
    add(inWords("Copy path"), [](const std::string& text) {
        QApplication::clipboard()->setText(QString::fromStdString(text));
    });
    return menu;
}

}  // namespace cortex::gui
