// SPDX-License-Identifier: Apache-2.0
// Faults and losses in the window, with a real agent over DDS.
#include "gui/rival.hpp"
#include "gui/window_fixture.hpp"
#include "views/base_view.hpp"
#include "views/event_list.hpp"
#include "views/graph_view.hpp"
#include "window/status_bar.hpp"

#include <QAbstractItemView>
#include <QPushButton>
#include <algorithm>
#include <csignal>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Abnormals : public Window {
protected:
    // A counter of the line at the bottom: "2 lost".
    QWidget* counter(const QString& text) {
        for (auto* each : window.findChild<StatusBar*>()->findChildren<QWidget*>()) {
            if (each->accessibleName() == text) return each;
        }
        return nullptr;
    }
    QWidget* anyCounter(const QString& end) {
        for (auto* each : window.findChild<StatusBar*>()->findChildren<QWidget*>()) {
            const QString name = each->accessibleName();
            if (name.endsWith(end) && name.front().isDigit() && name.front() != '0') return each;
        }
        return nullptr;
    }
    bool hasEvent(const QString& text) {
        const auto& rows =
            *window.findChild<EventList*>()->findChild<QAbstractItemView*>()->model();
        for (int row = 0; row < rows.rowCount(); ++row) {
            for (int column = 0; column < rows.columnCount(); ++column) {
                if (rows.index(row, column).data().toString().contains(text)) return true;
            }
        }
        return false;
    }
    std::string shown() {
        const auto* view = qobject_cast<BaseView*>(window.current());
        return view == nullptr ? std::string{} : view->path();
    }
    bool isLost() {
        return comes([this] { return session.frame()->agents.front().lost(); });
    }
};

TEST_F(Abnormals, AreCountedWhateverTheTreeShows) {
    ASSERT_TRUE(everythingComes());
    EXPECT_NE(counter("0 outside limits"), nullptr);
    window.tree().filter("agent:nobody");
    agent->end(SIGKILL);
    EXPECT_TRUE(comes([this] { return anyCounter(" lost") != nullptr; }));
    EXPECT_EQ(tree().rowCount(), 0);
}

TEST_F(Abnormals, AreOpenedByKeyAndByClick) {
    ASSERT_TRUE(everythingComes());
    agent->end(SIGKILL);
    ASSERT_TRUE(comes([this] { return anyCounter(" lost") != nullptr; }));
    QTest::keyClick(&window, Qt::Key_F8);
    EXPECT_EQ(shown(), "/mixer") << "one path stands for all of a lost agent";
    window.open(anActiveSimplex());
    QTest::mouseClick(anyCounter(" lost"), Qt::LeftButton);
    EXPECT_EQ(shown(), "/mixer");
}

TEST_F(Abnormals, ALostAgentGoesWhenAPersonDismissesIt) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    agent->end(SIGKILL);
    ASSERT_TRUE(comes([this] { return anyCounter(" lost") != nullptr; }));
    for (auto* each : window.current()->findChildren<QPushButton*>()) {
        if (each->text() == "Dismiss") QTest::mouseClick(each, Qt::LeftButton);
    }
    EXPECT_TRUE(comes([this] { return session.frame()->agents.empty(); }));
    EXPECT_TRUE(comes([this] { return counter("0 lost") != nullptr; }));
    EXPECT_EQ(tree().rowCount(), 0);
    start();
    EXPECT_TRUE(everythingComes()) << "it is seen again when it is heard again";
}

TEST_F(Abnormals, AnAgentThatIsLostAndOneThatComesBackAreRowsAmongTheEvents) {
    ASSERT_TRUE(everythingComes());
    agent->end(SIGKILL);
    EXPECT_TRUE(comes([this] { return hasEvent("agent lost"); }));
    start();
    EXPECT_TRUE(comes([this] { return hasEvent("agent restarted"); }));
    EXPECT_TRUE(comes([this] { return counter("0 lost") != nullptr; }));
}

TEST_F(Abnormals, AnOrderlyEndIsNoLoss) {
    ASSERT_TRUE(everythingComes());
    const std::string path = anActiveSimplex();
    agent->end(SIGTERM);
    EXPECT_TRUE(comes([this] { return hasEvent("agent ended"); }));
    EXPECT_FALSE(hasEvent("agent lost"));
    EXPECT_NE(counter("0 lost"), nullptr);
    EXPECT_TRUE(comes([&] { return wordOf(path).contains("ended"); }))
        << wordOf(path).toStdString();
}

TEST_F(Abnormals, WhatReadsAnAgentThatEndedInAnOrderlyWayIsNoLossAndSaysWhy) {
    const Background desk{agentCommand(systemFile(
        folder, "desk",
        "<simplex path=\"/desk/demanded\" type=\"RotaryAxisConcept\"/>"
        "<simplex path=\"/desk/controller\" type=\"HoldAxisController\">"
        "<relate rule=\"axes\" to=\"/axis/observed\" remote=\"true\" type=\"RotaryAxisConcept\"/>"
        "<relate rule=\"demands\" to=\"/desk/demanded\"/></simplex>"))};
    const auto isRead = [this](bool lost) {
        const auto frame = session.frame();
        const auto reader = frame->find("/desk/controller");
        return reader && frame->find("/axis/observed") &&
               frame->agents[reader->agent].came(reader->simplex) &&
               (frame->agents[reader->agent].quality(reader->simplex) == Quality::Lost) == lost;
    };
    ASSERT_TRUE(comes([&] { return isRead(false); }));
    window.open("/desk/controller");
    agent->end(SIGTERM);
    ASSERT_TRUE(comes([&] { return isRead(true) && hasEvent("agent ended"); }));
    const QString why = "The input /axis/observed is gone: mixer ended at ";
    EXPECT_TRUE(comes([&] { return shownTexts().find(why.toStdString()) != std::string::npos; }))
        << shownTexts();
    EXPECT_TRUE(comes([this] { return counter("0 lost") != nullptr; }));
    EXPECT_EQ(tree().marks(tree().indexOf("/desk/controller")).own, std::nullopt);
    session.dismiss("mixer");
    ASSERT_TRUE(comes([this] { return session.frame()->agents.size() == 1; }));
    const auto frames = session.frame()->number;
    EXPECT_TRUE(comes([&] { return session.frame()->number > frames + 10; }));
    EXPECT_NE(shownTexts().find(why.toStdString()), std::string::npos) << shownTexts();
    EXPECT_NE(counter("0 lost"), nullptr);
}

TEST_F(Abnormals, TheFaultOfTheSecondAgentOfAPathIsReadWhereItLeads) {
    ASSERT_TRUE(everythingComes());
    const Rival rival{ownNetwork(), true};
    ASSERT_TRUE(comes([this] { return anyCounter(" fault") != nullptr; }));
    QTest::keyClick(&window, Qt::Key_F8);
    EXPECT_EQ(shown(), "/drive");
    EXPECT_TRUE(comes([] {
        return shownTexts().find("rival has it in Fault 7: the axis does not follow.") !=
               std::string::npos;
    })) << shownTexts();
}

TEST_F(Abnormals, TheSystemStaysInFrontWhenWhatWasNamedComes) {
    window.open("/drive");
    window.openKind("system");
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(comes([this] { return tree().indexOf("/drive").isValid(); }));
    window.refresh();
    EXPECT_NE(qobject_cast<GraphView*>(window.current()), nullptr);
}

}  // namespace
}  // namespace cortex::test
