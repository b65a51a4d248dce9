// SPDX-License-Identifier: Apache-2.0
// The tree of simplexes: what is shown changes only by an act of a person.
#include "gui/made_agent.hpp"
#include "gui/waiting.hpp"
#include "views/system_tree.hpp"
#include "widgets/row_note.hpp"
#include "widgets/text_label.hpp"

#include <QAbstractItemModelTester>
#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QScrollBar>
#include <QTimer>
#include <QTreeView>
#include <vector>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace gui;

MadeAgent agentWith(const std::string& name, const std::vector<std::string>& paths) {
    return {name, [&](SimplexTree& tree) {
                for (const std::string& path : paths) tree.add(path, "Probe");
            }};
}

class Tree : public testing::Test {
protected:
    Tree() {
        QObject::connect(&tree, &SystemTree::chosen,
                         [this](const std::string& path) { chosen.push_back(path); });
        tree.resize(400, 400);
        tree.show();
    }
    QTreeView& rows() { return *tree.findChild<QTreeView*>(); }
    std::string current() { return tree.model().path(rows().currentIndex()); }
    void key(Qt::Key key) {
        QKeyEvent press{QEvent::KeyPress, key, Qt::NoModifier};
        QApplication::sendEvent(&rows(), &press);
    }
    QString trouble() {
        for (const auto* label : tree.findChildren<TextLabel*>()) {
            if (!label->isHidden() && label->text().startsWith("Nothing matches")) {
                return label->text();
            }
        }
        return {};
    }

    // Of its upper edge, in the tree: what is above the rows does not move.
    int heightOf(const std::string& path) {
        const QRect row = rows().visualRect(tree.model().indexOf(path));
        return rows().viewport()->mapTo(&tree, row.topLeft()).y();
    }
    void pointAt(const std::string& path) {
        QApplication::processEvents();
        const QRect row = rows().visualRect(tree.model().indexOf(path));
        QTest::mouseMove(rows().viewport(), row.center());
        QEvent enter{QEvent::Enter};
        QApplication::sendEvent(rows().viewport(), &enter);
        ASSERT_EQ(underPointer(), path);
    }
    std::string underPointer() {
        QApplication::processEvents();
        const QPoint at = rows().viewport()->mapFromGlobal(QCursor::pos());
        const QModelIndex index = rows().indexAt(at);
        return index.isValid() ? tree.model().path(index) : "";
    }
    void leaveRows() {
        QTest::mouseMove(&tree, {5, 5});
        QEvent leave{QEvent::Leave};
        QApplication::sendEvent(rows().viewport(), &leave);
        QApplication::processEvents();
    }

    SystemTree tree;
    QAbstractItemModelTester tester{const_cast<SystemModel*>(&tree.model()),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
    std::vector<std::string> chosen;
    MadeAgent robot = agentWith("robot", {"/control/clutch", "/control/hold", "/drive"});
    MadeAgent operators = agentWith("operator", {"/hand", "/playback"});
    MadeAgent arms = agentWith("arms", {"/a1", "/a2", "/a3", "/a4", "/a5", "/a6", "/a7", "/a8"});
};

TEST_F(Tree, APartOfThePlantIsChosenWithoutOpeningAnything) {
    tree.refresh(frameOf({robot.now(), operators.now()}));
    tree.choose("/control/clutch");
    EXPECT_EQ(tree.meant("/drive"), "/drive");
    chosen.clear();
    key(Qt::Key_Up);
    EXPECT_EQ(tree.meant("/drive"), "/control");
    EXPECT_TRUE(chosen.empty());
}

TEST_F(Tree, ItsRowIsMeantWhereNoSimplexIsShown) {
    tree.refresh(frameOf({robot.now(), operators.now()}));
    EXPECT_EQ(tree.meant(""), "");
    tree.choose("/control/clutch");
    EXPECT_EQ(tree.meant(""), "/control/clutch");
}

TEST_F(Tree, RowsThatGoOpenNoOtherSimplex) {
    tree.refresh(frameOf({robot.now(), operators.now()}));
    tree.choose("/playback");
    chosen.clear();
    tree.refresh(frameOf({robot.now()}));
    EXPECT_TRUE(chosen.empty()) << "nobody chose " << chosen.front();
    EXPECT_EQ(current(), "") << "nothing is marked as chosen that nobody chose";
    tree.refresh(frameOf({robot.now(), operators.now()}));
    EXPECT_EQ(current(), "/playback") << "it is chosen still";
    EXPECT_TRUE(chosen.empty());
}

TEST_F(Tree, TypingInTheFilterOpensNoOtherSimplex) {
    tree.refresh(frameOf({robot.now()}));
    tree.choose("/control/hold");
    chosen.clear();
    for (const char* typed : {"c", "cl", "clu", "clutch", "clut", "c", "drive", ""}) {
        tree.filter(QString::fromUtf8(typed));
    }
    EXPECT_TRUE(chosen.empty()) << "nobody chose " << chosen.front();
    EXPECT_EQ(current(), "/control/hold");
}

TEST_F(Tree, DownFromTheFilterGoesToTheRowThatIsChosenWhereItIsShown) {
    tree.refresh(frameOf({robot.now()}));
    tree.choose("/control/hold");
    chosen.clear();
    auto* filter = tree.findChild<QLineEdit*>();
    const auto down = [&] {
        tree.focusFilter();
        QTest::keyClick(filter, Qt::Key_Down);
    };
    down();
    EXPECT_EQ(current(), "/control/hold");
    EXPECT_TRUE(chosen.empty()) << "what is shown stays";
    tree.filter("clutch");
    down();
    EXPECT_NE(current(), "/control/hold") << "it is not shown";
    EXPECT_TRUE(rows().currentIndex().isValid());
}

TEST_F(Tree, AKeyOpensWhatItGoesTo) {
    tree.refresh(frameOf({robot.now()}));
    tree.choose("/control/clutch");
    chosen.clear();
    key(Qt::Key_Down);
    EXPECT_EQ(chosen, std::vector<std::string>{"/control/hold"});
    key(Qt::Key_Up);
    key(Qt::Key_Up);  // the row of a path without a simplex stays current
    tree.refresh(frameOf({robot.now()}));
    EXPECT_EQ(current(), "/control");
    EXPECT_EQ(chosen.back(), "/control/clutch");
}

TEST_F(Tree, TheRowUnderThePointerStaysThereWhileOthersComeAndGo) {
    tree.refresh(frameOf({robot.now()}));
    QApplication::processEvents();
    const int top = heightOf("/control");
    pointAt("/drive");
    const int place = heightOf("/drive");
    for (int i = 0; i < 3; ++i) {  // above it, beyond what there is to scroll
        tree.refresh(frameOf({robot.now(), arms.now(), operators.now()}));
        EXPECT_EQ(underPointer(), "/drive");
        EXPECT_EQ(heightOf("/drive"), place);
        tree.refresh(frameOf({robot.now(), operators.now()}));
        EXPECT_EQ(underPointer(), "/drive");
        EXPECT_EQ(heightOf("/drive"), place);
    }
    tree.refresh(frameOf({robot.now(), arms.now()}));
    leaveRows();
    EXPECT_EQ(heightOf("/a1"), top) << "all rows have room";
    EXPECT_EQ(rows().verticalScrollBar()->maximum(), 0);
}

TEST_F(Tree, TheRowUnderThePointerStaysThereAlsoWhereTooLittleIsLeftToScroll) {
    tree.refresh(frameOf({robot.now(), arms.now()}));
    QApplication::processEvents();
    const int top = heightOf("/a1");
    pointAt("/drive");
    const int place = heightOf("/drive");
    for (int i = 0; i < 3; ++i) {
        tree.refresh(frameOf({robot.now()}));
        EXPECT_EQ(underPointer(), "/drive");
        EXPECT_EQ(heightOf("/drive"), place);
    }
    tree.resize(400, 420);
    EXPECT_EQ(underPointer(), "/drive");
    tree.filter("drive");
    EXPECT_EQ(heightOf("/drive"), top) << "who types looks for what is found";
    tree.filter("");
    tree.refresh(frameOf({robot.now(), arms.now()}));
    pointAt("/drive");
    tree.refresh(frameOf({robot.now()}));
    leaveRows();
    EXPECT_EQ(heightOf("/control"), top) << "nothing is above the rows";
}

TEST_F(Tree, APressWhereARowHasJustGoneIsNotOneOnTheNext) {
    std::vector<std::string> menus;
    QObject::connect(&tree, &SystemTree::menuWanted,
                     [&](const std::string& path) { menus.push_back(path); });
    tree.refresh(frameOf({robot.now(), operators.now()}));
    pointAt("/control/clutch");
    auto* gone = rows().findChild<QTimer*>({}, Qt::FindDirectChildrenOnly);
    if (gone != nullptr) gone->setInterval(1'000'000);
    tree.refresh(frameOf({operators.now()}));
    ASSERT_EQ(underPointer(), "/playback");
    const auto press = [&] {
        const QPoint at = rows().viewport()->mapFromGlobal(QCursor::pos());
        QTest::mouseClick(rows().viewport(), Qt::LeftButton, Qt::NoModifier, at);
        QContextMenuEvent menu{QContextMenuEvent::Mouse, at, QCursor::pos()};
        QApplication::sendEvent(rows().viewport(), &menu);
    };
    press();
    EXPECT_TRUE(chosen.empty()) << chosen.front();
    EXPECT_TRUE(menus.empty()) << menus.front();
    ASSERT_NE(gone, nullptr);
    gone->setInterval(0);
    ASSERT_TRUE(comes([&] { return !gone->isActive(); }));
    press();
    EXPECT_EQ(chosen, std::vector<std::string>{"/playback"});
    EXPECT_EQ(menus, std::vector<std::string>{"/playback"});
}

TEST_F(Tree, SaysThatNothingMatchesOnlyWhileItIsTrue) {
    tree.filter("playback");
    tree.refresh(frameOf({robot.now()}));
    EXPECT_TRUE(trouble().contains("playback"));
    tree.refresh(frameOf({robot.now(), operators.now()}));
    EXPECT_EQ(trouble(), "");
    tree.refresh(frameOf({robot.now()}));
    EXPECT_TRUE(trouble().contains("playback"));
}

TEST_F(Tree, SaysHowManyTheFilterShowsAlsoWhenOnlyTheirValuesChange) {
    const auto counts = [this](const QString& text) {
        const auto labels = tree.findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) { return each->text() == text; });
    };
    // The window takes the newest frame: it does not see all of them.
    const auto show = [this](std::uint64_t number) {
        const auto frame = frameOf({robot.now()});
        frame->number = number;
        frame->structures = 1'000'000;
        tree.refresh(frame);
    };
    robot.put("/drive", "state", std::int64_t{2});
    show(1);
    EXPECT_TRUE(counts("3 in 1 agent"));
    tree.filter("state:Active");
    EXPECT_TRUE(counts("1 of 3 shown"));
    robot.put("/control/hold", "state", std::int64_t{2});
    show(31);
    EXPECT_TRUE(counts("2 of 3 shown"));
}

TEST_F(Tree, NothingMovesWhenItHasSomethingToSay) {
    tree.refresh(frameOf({robot.now()}));
    QApplication::processEvents();
    const QRect place = rows().geometry(), first = rows().visualRect(rows().indexAt({5, 5}));
    for (const char* typed : {"in:", "nonsense:1", "playback"}) {
        tree.filter(typed);
        QApplication::processEvents();
        EXPECT_EQ(rows().geometry(), place) << typed;
    }
    const auto* note = rows().findChild<RowNote*>();
    ASSERT_TRUE(note->isVisible());
    EXPECT_TRUE(rows().rect().contains(note->geometry()));
    EXPECT_EQ(rows().viewport()->geometry().bottom(), note->geometry().bottom());
    tree.filter("");
    EXPECT_FALSE(note->isVisible());
    EXPECT_EQ(rows().visualRect(rows().indexAt({5, 5})), first);
}

TEST_F(Tree, ACountThatHasNoRoomPushesNothing) {
    std::vector<std::string> paths;
    for (int i = 0; i < 1'000; ++i) paths.push_back("/part/" + std::to_string(i));
    MadeAgent plant = agentWith("plant", paths);
    tree.resize(150, 400);
    tree.refresh(frameOf({plant.now(), robot.now(), operators.now()}));
    QApplication::processEvents();
    for (const auto* each : tree.findChildren<TextLabel*>()) {
        if (each->text() == "Simplexes") EXPECT_GE(each->width(), each->sizeHint().width());
    }
    EXPECT_EQ(tree.width(), 150);
}

TEST_F(Tree, SaysNothingOfAFilterWhileNobodyIsHeard) {
    tree.filter("playback");
    EXPECT_EQ(trouble(), "") << "there is nothing yet that could match";
}

TEST_F(Tree, SortsNumbersInNamesAsNumbers) {
    MadeAgent wheels = agentWith("robot", {"/w10", "/w2", "/w1a", "/w1", "/x"});
    tree.refresh(frameOf({wheels.now()}));
    std::vector<std::string> names;
    for (int i = 0; i < tree.model().rowCount(); ++i) {
        names.push_back(tree.model().path(tree.model().index(i, 0)));
    }
    EXPECT_EQ(names, (std::vector<std::string>{"/w1", "/w1a", "/w2", "/w10", "/x"}));
}

TEST_F(Tree, WhatIsInStandbyIsNotMarkedAsUntrusted) {
    robot.put("/drive", "state", std::int64_t{0});
    robot.degrade("/drive", Quality::Stale);
    robot.put("/control/hold", "state", std::int64_t{2});
    robot.degrade("/control/hold", Quality::Stale);
    tree.refresh(frameOf({robot.now()}));
    EXPECT_EQ(tree.model().marks(tree.model().indexOf("/drive")).own, std::nullopt)
        << "it writes nothing, as it should";
    EXPECT_EQ(tree.model().marks(tree.model().indexOf("/control/hold")).own, Shape::Stale);
    EXPECT_EQ(tree.model().marks(tree.model().indexOf("/control")).worst, Shape::Stale);
}

}  // namespace
}  // namespace cortex::test
