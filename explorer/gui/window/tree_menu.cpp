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

// Whose own row it is; empty: it is of no agent.
std::string agentOf(const Frame& frame, const std::string& path) {
    const auto place = frame.find(path);
    if (!place || !frame.type(*place).isA("Agent")) return {};
    return frame.agents[place->agent].status.name;
}

QString inMenu(QString text) { return text.replace('&', QLatin1String{"&&"}); }

}  // namespace

QMenu* makeTreeMenu(const Frame& frame, const std::string& path, const TreeActions& actions,
                    QWidget* parent) {
    auto* menu = new QMenu{parent};
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const auto add = [&](const QString& text, const TreeActions::Action& action) {
        menu->addAction(text, menu, [action, path] { action(path); });
    };
    const QString scope = inMenu(scopeText(path));
    if (frame.find(path)) {
        add(inWords("Open"), actions.open);
        add(inWords("Open in a tab of its own"), actions.openTab);
        menu->addSeparator();
    }
    const std::string agent = agentOf(frame, path);
    const std::string all = agent.empty() ? path : "/";
    const QString of =
        agent.empty() ? scope : inWords("agent %1").arg(inMenu(QString::fromStdString(agent)));
    add(inWords("Take control of %1…").arg(scope), actions.takeControl);
    menu->addAction(inWords("Start all of %1").arg(of), menu,
                    [start = actions.startAll, all, agent] { start(all, agent); });
    menu->addAction(inWords("Stop all of %1").arg(of), menu,
                    [stop = actions.stopAll, all, agent] { stop(all, agent); });
    menu->addSeparator();
    add(inWords("Copy path"), [](const std::string& text) {
        QApplication::clipboard()->setText(QString::fromStdString(text));
    });
    return menu;
}

}  // namespace cortex::gui
