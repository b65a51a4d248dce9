// SPDX-License-Identifier: Apache-2.0
// The manual that is built into the window.
#include "gui/window_fixture.hpp"
#include "views/manual_view.hpp"
#include "window/stop_button.hpp"

#include <QTextBlock>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace cortex::gui;

TEST_F(Window, OpensItsManualAtWhatIsSaidOfWhatHasTheKeyboard) {
    QApplication::setActiveWindow(&window);
    window.tree().focusFilter();
    QTest::keyClick(&window, Qt::Key_F1);
    ASSERT_NE(window.manual(), nullptr);
    EXPECT_EQ(window.current(), window.manual());
    EXPECT_EQ(window.manual()->section(), "Finding something");
    EXPECT_EQ(window.manual()->textCursor().block().text(), "Finding something");

    window.stopButton().setFocus();
    QTest::keyClick(&window, Qt::Key_F1);
    EXPECT_EQ(window.manual()->section(), "Stop");
    EXPECT_EQ(window.findChildren<ManualView*>().size(), 1) << "it is opened once";
}

TEST_F(Window, NamesOnlySectionsThatTheManualHas) {
    window.openManual();
    const QStringList sections = window.manual()->sections();
    EXPECT_GT(sections.size(), 5);
    for (const QWidget* each : window.findChildren<QWidget*>()) {
        const QString section = ManualView::sectionOf(each);
        EXPECT_TRUE(section.isEmpty() || sections.contains(section)) << section.toStdString();
    }
    EXPECT_TRUE(sections.contains("What it shows")) << "where F1 goes from everything else";
}

TEST_F(Window, ShowsTheManualInEachThemeWithoutItsPictures) {
    window.openManual();
    const QString text = window.manual()->toPlainText();
    EXPECT_TRUE(text.contains("Ctrl+Shift+T")) << "a key of its table";
    EXPECT_FALSE(text.contains("pictures/"));
}

}  // namespace
}  // namespace cortex::test
