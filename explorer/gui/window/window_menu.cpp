// SPDX-License-Identifier: Apache-2.0
#include "window/window_menu.hpp"

#include "model/permission.hpp"
#include "model/shown_time.hpp"
#include "session/utc_now.hpp"
#include "window/control_bar.hpp"
#include "window/find_actions.hpp"
#include "window/layout_menu.hpp"
#include "window/orders.hpp"
#include "window/pages.hpp"
#include "window/stop_button.hpp"

#include <QAction>
#include <QActionGroup>
#include <QCoreApplication>
#include <QMenu>
#include <array>
#include <optional>
#include <string>

namespace cortex::gui {

namespace {

constexpr std::array scales{1.0, 1.25, 1.5};

QString entry(const char* text) { return QCoreApplication::translate("WindowMenu", text); }

// Without control there is nothing to hand over: the entry says so.
void addHandOver(QMenu& menu, ControlBar& control) {
    QAction* choice =
        menu.addAction(entry("Hand over control…"), &control, &ControlBar::chooseHandOver);
    QObject::connect(&menu, &QMenu::aboutToShow, choice, [&control, choice] {
        choice->setEnabled(control.holds());
        choice->setText(control.holds() ? entry("Hand over control…")
                                        : entry("Hand over control: you hold nothing"));
    });
}

// What is missing of what was held, as the bar offers it where there is room.
void addTakeAgain(QMenu& menu, ControlBar& control) {
    QAction* choice = menu.addAction(entry("Take again"), &control, &ControlBar::takeAgain);
    QObject::connect(&menu, &QMenu::aboutToShow, choice, [&control, choice] {
        const std::string prefix = control.missing();
        const QString scope = scopeText(prefix).replace('&', QLatin1String{"&&"});
        choice->setEnabled(!prefix.empty());
        choice->setText(prefix.empty() ? entry("Take again: nothing is missing")
                                       : entry("Take %1 again").arg(scope));
    });
}

// As the row below the bar offers it, also once that was closed.
void addStarts(QMenu& menu, Orders& orders) {
    StartAgain& again = orders.startAgain();
    QAction* choice = menu.addAction({}, &again, &StartAgain::begin);
    QObject::connect(&menu, &QMenu::aboutToShow, choice, [&again, choice] {
        const QString why = again.whyNot();
        choice->setEnabled(why.isEmpty());
        choice->setText(why.isEmpty() ? entry("Start again what Stop stopped")
                                      : entry("Start again: %1").arg(why));
    });
    QAction* all = menu.addAction(entry("Start all…"), &orders, [&orders, &menu] {
        orders.startAll().ask(*menu.parentWidget()->window());
    });
    all->setProperty(onlyInMenu, true);
}

}  // namespace

QMenu* makeWindowMenu(const WindowActions& actions, QWidget* parent) {
    auto* menu = new QMenu{parent};
    menu->addAction(entry("Find…  Ctrl+K"), menu, actions.find);
    QMenu* views = menu->addMenu(entry("Views"));
    for (const PageKind& each : pageKinds()) {
        views->addAction(QString{each.title}.replace('&', QLatin1String{"&&"}), menu,
                         [open = actions.openKind, kind = each.kind] { open(kind); });
    }
    views->addAction(entry("New plot"), menu, actions.newPlot);
    menu->addAction(entry("Plot what is chosen  Ctrl+G"), menu, actions.plot);
    menu->addAction(entry("Side by side  Ctrl+\\"), menu, actions.split);
    menu->addAction(entry("Open the closed tab again  Ctrl+Shift+W"), menu, actions.reopen);
    QMenu* layouts = menu->addMenu(entry("Layout"));
    layouts->setProperty(foundToo, true);
    addLayout(*layouts, actions.layout);
    menu->addSeparator();
    menu->addAction(entry("Next theme"), menu, actions.nextTheme);
    for (const double scale : scales) {
        menu->addAction(entry("Text %1 %").arg(scale * 100), menu,
                        [set = actions.scale, scale] { set(scale); });
    }
    addTimes(*menu->addMenu(entry("Times")), actions.localTime);
    fillUnitMenu(*menu->addMenu(entry("Units of this view")), actions.units);
    addRates(*menu->addMenu(entry("Values")), actions.session);
    addScopes(*menu->addMenu(entry("Stop stops")), actions.session, actions.orders.stop());
    addStarts(*menu, actions.orders);
    menu->addSeparator();
    addTakeAgain(*menu, actions.control);
    addHandOver(*menu, actions.control);
    menu->addAction(entry("Manual"), menu, actions.openManual);
    QAction* join = menu->addAction(entry("Join again"), menu,
                                    [&session = actions.session] { session.joinAgain(); });
    QAction* quit = menu->addAction(entry("Quit"), menu, actions.quit);
    for (QAction* each : {join, quit}) each->setProperty(discardsSomething, true);
    return menu;
}

void addTimes(QMenu& menu, const std::function<void(bool)>& choose) {
    auto* choices = new QActionGroup{&menu};
    for (const bool local : {false, true}) {
        QAction* choice =
            menu.addAction(entry("In UTC"), &menu, [choose, local] { choose(local); });
        choice->setCheckable(true);
        choices->addAction(choice);
        QObject::connect(&menu, &QMenu::aboutToShow, choice, [choice, local] {
            if (local) choice->setText(entry("In local time (%1)").arg(localZoneName(utcNow())));
            choice->setChecked(showsLocalTime() == local);
        });
    }
}

void addRates(QMenu& menu, Session& session) {
    auto* choices = new QActionGroup{&menu};
    for (const std::uint32_t rate : Session::rates) {
        QAction* choice = menu.addAction(rate == 0 ? entry("In every cycle")
                                                   : entry("%1 times a second").arg(rate));
        choice->setCheckable(true);
        choices->addAction(choice);
        QObject::connect(choice, &QAction::triggered, &menu,
                         [&session, rate] { session.setRate(rate); });
        QObject::connect(&menu, &QMenu::aboutToShow, choice, [&session, choice, rate] {
            choice->setChecked(session.frame()->rate == rate);
        });
    }
}

void addScopes(QMenu& menu, Session& session, StopButton& stop) {
    QObject::connect(&menu, &QMenu::aboutToShow, &stop, [&menu, &session, &stop] {
        menu.clear();
        const auto add = [&](const QString& text, const std::optional<std::string>& scope) {
            QAction* choice = menu.addAction(text, &stop, [&stop, scope] { stop.setScope(scope); });
            choice->setCheckable(true);
            choice->setChecked(stop.chosenScope() == scope);
        };
        add(entry("What is controlled; otherwise all, at the second press"), std::nullopt);
        add(entry("Always all"), "/");
        for (const std::string& each : scopesOf(*session.frame())) {
            add(entry("Always %1")
                    .arg(QString::fromStdString(each).replace('&', QLatin1String{"&&"})),
                each);
        }
    });
}

}  // namespace cortex::gui
