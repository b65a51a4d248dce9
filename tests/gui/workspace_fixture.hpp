// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/window_fixture.hpp"
#include "window/find_panel.hpp"
#include "window/workspace.hpp"

#include <QLabel>
#include <QLineEdit>
#include <QTreeWidget>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {

// A window with its tabs and keys.
class Workspaces : public Window {
protected:
    QStringList titles(std::size_t pane) {
        QStringList all;
        const Pane& shown = *window.workspace().panes()[pane];
        for (int tab = 0; tab < shown.count(); ++tab) all << shown.title(tab);
        return all;
    }
    void press(const char* combination) {
        QApplication::setActiveWindow(&window);
        QTest::keySequence(&window, QKeySequence{QLatin1String{combination}});
    }
    QString said() {
        const auto* label = window.current()->findChild<QLabel*>("said");
        return label == nullptr ? QString{} : label->text();
    }
    void finds(const char* words) {
        press("Ctrl+K");
        ASSERT_NE(window.findPanel(), nullptr);
        window.findPanel()->field().setText(words);
    }
    QString firstFound() { return window.findPanel()->list().topLevelItem(0)->text(0); }
};

}  // namespace cortex::test
