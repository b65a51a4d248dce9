// SPDX-License-Identifier: Apache-2.0
// Ctrl+K, and where the keyboard is after something was opened, with a real agent over DDS.
#include "gui/editing.hpp"
#include "style/look.hpp"
#include "views/base_view.hpp"
#include "views/command_card.hpp"
#include "views/event_table.hpp"
#include "window/find_panel.hpp"
#include "window/layout_keeper.hpp"
#include "window/workspace.hpp"

#include <QPointer>
#include <QTabBar>
#include <QTreeView>
#include <QTreeWidget>

namespace cortex::test {
namespace {

class Finding : public Editing {
protected:
    Finding() : Editing{"AxisPoseController"} { QApplication::setActiveWindow(&window); }

    static QWidget* focused() { return QApplication::focusWidget(); }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(focused() != nullptr ? focused() : &window, key, modifiers);
    }
    // Ctrl+K, the words, Enter.
    void finds(const char* words, const char* first,
               Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        key(Qt::Key_K, Qt::ControlModifier);
        ASSERT_NE(window.findPanel(), nullptr);
        QTest::keyClicks(&window.findPanel()->field(), words);
        ASSERT_GT(window.findPanel()->list().topLevelItemCount(), 0) << words;
        EXPECT_EQ(window.findPanel()->list().topLevelItem(0)->text(0), first);
        QTest::keyClick(&window.findPanel()->field(), Qt::Key_Return, modifiers);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QApplication::processEvents();
        QApplication::setActiveWindow(&window);  // as it is on a screen
    }
    // Whether all of it, or as much as has room, is in sight within the area that scrolls it.
    static bool isInSight(const QWidget& widget, const QWidget& area) {
        const QRect place{widget.mapTo(&area, QPoint{}), widget.size()};
        return area.rect().contains(place.topLeft() + QPoint{5, 5});
    }
};

TEST_F(Finding, SetsAValueWithFourKeysBesideTheLettersOfItsName) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(takes("/"));
    window.open("/controller");
    window.openPart("type");
    window.tree().setFocus();
    finds("drive damp", "/drive.dampingRatio");  // with the first two keys
    ASSERT_TRUE(comes([this] { return valueOf("dampingRatio") != "…"; }));
    EXPECT_EQ(focused(), &table());
    EXPECT_EQ(table().currentIndex(), cellOf("dampingRatio"));
    QTest::keyClick(focused(), '1');
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "1") << "what is typed takes the place of the value";
    key(Qt::Key_Return);
    EXPECT_TRUE(says("Set: dampingRatio "));
    EXPECT_TRUE(comes([this] { return valueOf("dampingRatio") == "1"; }));
}

TEST_F(Finding, ScrollsToTheItemAndOpensItsGroup) {
    ASSERT_TRUE(isReady());
    window.resize(800, 600);
    const QModelIndex cell = cellOf("dampingRatio");
    for (int group = 0; group < table().model()->rowCount(); ++group)
        table().collapse(table().model()->index(group, 0));
    finds("drive state", "/drive.state");
    EXPECT_TRUE(table().isExpanded(cellOf("state").parent()));
    EXPECT_TRUE(table().viewport()->rect().contains(table().visualRect(cellOf("state")).center()));
    EXPECT_EQ(table().currentIndex(), cellOf("state"));
    QTest::keyClicks(&table(), "d ");
    EXPECT_EQ(field(), nullptr) << "it cannot be set";
    table().setCurrentIndex(cell);
    for (const Qt::Key each : {Qt::Key_Escape, Qt::Key_Space, Qt::Key_Delete, Qt::Key_Backspace})
        key(each);
    key(Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(field(), nullptr) << "these are no characters";
}

TEST_F(Finding, ACommandHasTheKeyboardInItsOwnForm) {
    ASSERT_TRUE(everythingComes());
    window.resize(800, 600);
    finds("controller moveto", "/controller moveTo");
    CommandCard* form = nullptr;
    for (auto* each : window.current()->findChildren<CommandCard*>())
        if (each->command().name == "moveTo") form = each;
    ASSERT_NE(form, nullptr);
    EXPECT_TRUE(form->isAncestorOf(focused()));
    EXPECT_NE(qobject_cast<QLineEdit*>(focused()), nullptr) << "in its first field";
    EXPECT_TRUE(isInSight(*form, *form->parentWidget()->parentWidget()));
    finds("drive startup", "/drive startup");
    EXPECT_TRUE(window.current()->isAncestorOf(focused())) << "read-only: Run is off";
    ASSERT_TRUE(takes("/"));
    window.refresh();
    finds("drive startup", "/drive startup");
    const auto* run = qobject_cast<QPushButton*>(focused());
    ASSERT_NE(run, nullptr);
    EXPECT_EQ(run->accessibleName(), "Run startup");
}

TEST_F(Finding, SimplexesViewsAndAgentsTakeTheKeyboardFromTheTree) {
    ASSERT_TRUE(isReady());
    for (const auto& [words, first] : {std::pair{"/drive", "/drive"}, {"mixer", "/mixer"}}) {
        window.tree().findChild<QTreeView*>()->setFocus();
        finds(words, first);
        EXPECT_EQ(window.workspace().path(), first);
        EXPECT_EQ(focused(), &table());
    }
    for (const char* view : {"System", "Agents", "Events", "Plot", "Compare", "Manual"}) {
        window.tree().findChild<QTreeView*>()->setFocus();
        finds(view, view);
        ASSERT_NE(focused(), nullptr) << view;
        EXPECT_TRUE(window.current() == focused() || window.current()->isAncestorOf(focused()))
            << view;
    }
}

TEST_F(Finding, FindsTheLayoutsOfTheMenuAndBeginsAnew) {
    ASSERT_TRUE(isReady());
    key(Qt::Key_K, Qt::ControlModifier);
    ASSERT_NE(window.findPanel(), nullptr);
    QLineEdit& words = window.findPanel()->field();
    QTest::keyClicks(&words, "reset layout");
    ASSERT_EQ(window.findPanel()->list().topLevelItemCount(), 1);
    EXPECT_EQ(window.findPanel()->list().topLevelItem(0)->text(0), "Layout: Reset");
    QTest::keyClick(&words, Qt::Key_K, Qt::ControlModifier);
    EXPECT_EQ(words.selectedText(), "reset layout");
    window.find();
    EXPECT_EQ(words.selectedText(), "reset layout");
    window.findPanel()->close();
}

TEST_F(Finding, WhatDiscardsIsFoundAfterAllElseAndAResetCanBeTakenBack) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/"));
    const auto found = [&](const char* words) {
        key(Qt::Key_K, Qt::ControlModifier);
        window.findPanel()->field().setText(words);
        QStringList all;
        for (int i = 0; i < window.findPanel()->list().topLevelItemCount(); ++i)
            all << window.findPanel()->list().topLevelItem(i)->text(0);
        window.findPanel()->close();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QApplication::setActiveWindow(&window);
        return all;
    };
    EXPECT_EQ(found("control").first(), "Take control…") << "before /controller";
    EXPECT_EQ(found("layout").first(), "Layout: Open…");
    EXPECT_EQ(found("layout").last(), "Layout: Reset");
    for (const auto& [words, last] : {std::pair{"q", "Quit"}, {"rel", "Release control"}}) {
        EXPECT_GT(found(words).size(), 1) << words;
        EXPECT_EQ(found(words).last(), last);
    }
    window.openTab("/mixer");
    const auto& pane = *window.workspace().panes()[0];
    const int before = pane.count();
    window.layouts().reset();
    const int after = pane.count();
    ASSERT_LT(after, before);
    for (const int count : {before, after, before}) {
        window.layouts().goBack();
        EXPECT_EQ(pane.count(), count) << "going back can be taken back, too";
    }
}

TEST_F(Finding, ACommandsNameIsInSightAlsoWhereItsFormIsHigherThanTheView) {
    ASSERT_TRUE(everythingComes());
    window.resize(800, 600);
    Look::apply(Theme::Light, 1.5, QStringLiteral("DejaVu Sans"));
    finds("controller moveto", "/controller moveTo");
    QApplication::processEvents();
    for (auto* form : window.current()->findChildren<CommandCard*>()) {
        if (form->command().name != "moveTo") continue;
        EXPECT_TRUE(isInSight(*form, *form->parentWidget()->parentWidget()))
            << form->mapTo(form->parentWidget()->parentWidget(), QPoint{}).y();
    }
    Look::apply(Theme::Light, 1, QStringLiteral("Open Sans"));
}

TEST_F(Finding, ActionsOfTheWindowAreDone) {
    ASSERT_TRUE(isReady());
    EXPECT_FALSE(window.workspace().panes()[1]->isVisible());
    finds("side by", "Side by side");
    EXPECT_TRUE(window.workspace().panes()[1]->isVisible());
    finds("take control", "Take control…");
    ASSERT_NE(window.control().panel(), nullptr);
    window.control().panel()->close();
}

TEST_F(Finding, ACompletedWordStartsNoPlant) {
    ASSERT_TRUE(isReady());
    key(Qt::Key_K, Qt::ControlModifier);
    ASSERT_NE(window.findPanel(), nullptr);
    QTest::keyClicks(&window.findPanel()->field(), "start all");
    const auto all = window.findPanel()->list().findItems("Start all", Qt::MatchStartsWith);
    EXPECT_TRUE(all.isEmpty());
    window.findPanel()->close();
}

TEST_F(Finding, TheKeyboardWaitsForWhatHasNotComeYet) {
    QWidget* elsewhere = window.tree().findChild<QTreeView*>();
    for (const bool stays : {true, false}) {
        elsewhere->setFocus();
        window.open(stays ? "/drive" : "/controller");
        auto& view = *qobject_cast<BaseView*>(window.current());
        auto nothing = std::make_shared<Frame>();
        view.refresh(nothing);
        view.enter("data", "state");
        if (!stays) elsewhere->setFocus();
        ASSERT_TRUE(everythingComes());
        view.refresh(session.frame());
        EXPECT_EQ(focused(), stays ? &table() : elsewhere);
        if (stays) EXPECT_EQ(table().currentIndex(), cellOf("state"));
    }
}

TEST_F(Finding, WhatIsOpenGetsNoSecondTab) {
    ASSERT_TRUE(everythingComes());
    const auto& pane = *window.workspace().panes()[0];
    auto* rows = window.tree().findChild<QTreeView*>();
    window.open("/drive");
    const int count = pane.count();
    rows->setFocus();
    key(Qt::Key_Return);
    EXPECT_EQ(pane.count(), count) << "it was there already";
    EXPECT_TRUE(pane.page(pane.chosen()).pinned);
    EXPECT_TRUE(window.current()->isAncestorOf(focused()))
        << (focused() ? focused()->metaObject()->className() : "nobody");
    window.open("/controller");
    EXPECT_EQ(pane.count(), count + 1);
    EXPECT_FALSE(pane.page(pane.chosen()).pinned);
    window.open("/axis/observed");
    EXPECT_EQ(pane.count(), count + 1) << "one that follows is enough";
    window.openTab("/drive");
    EXPECT_EQ(pane.count(), count + 1);
    EXPECT_EQ(window.workspace().path(), "/drive");
    window.openTab("/axis/demanded");
    key(Qt::Key_W, Qt::ControlModifier);
    window.open("/axis/demanded");
    key(Qt::Key_W, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(pane.count(), count + 1);
    EXPECT_TRUE(pane.page(pane.chosen()).pinned) << "as it was when it was closed";
    for (int i = 0; i < 2; ++i) finds("/drive", "/drive", Qt::ControlModifier);
    EXPECT_EQ(pane.count() + window.workspace().panes()[1]->count(), count + 2);
}

TEST_F(Finding, APinnedFirstTabComesBackWithoutAnotherOne) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.openTab("/drive");
    window.open("/controller");
    const QJsonObject saved = window.workspace().saved();
    window.workspace().restore(saved);
    EXPECT_EQ(window.workspace().saved(), saved);
    const auto& pane = *window.workspace().panes()[0];
    EXPECT_EQ(pane.page(pane.find("simplex")).pinned, true);
}

}  // namespace
}  // namespace cortex::test
