// SPDX-License-Identifier: Apache-2.0
// Control and commands from the window, with a real agent over DDS.
#include "gui/controlling.hpp"
#include "widgets/question.hpp"
#include "widgets/value_field.hpp"
#include "window/control_notice.hpp"
#include "window/start_all.hpp"
#include "window/stop_button.hpp"

#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QRadioButton>
#include <QSet>
#include <QTreeView>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

TEST_F(Controlling, IsReadOnlyAtFirstAndSaysHowToTakeControl) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_EQ(window.control().text(), "Read-only; Stop works");
    EXPECT_FALSE(button("Startup").isEnabled());
    EXPECT_TRUE(says("read-only: take control of /drive"));
    ASSERT_EQ(live({"call", "/drive", "startup"}).exit, 0);
    EXPECT_TRUE(comes([this] {
        window.refresh();
        return button("Shutdown").isEnabled();
    })) << "whoever looks may stop";
    EXPECT_TRUE(says("needs Fault"));
}

TEST_F(Controlling, TakesControlCommandsAndReleases) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    EXPECT_TRUE(window.control().text().startsWith("You control /drive since "));
    EXPECT_NE(leases().find("/drive"), std::string::npos);
    window.refresh();
    ASSERT_TRUE(button("Startup").isEnabled());
    EXPECT_TRUE(says("needs StartingUp or Active"));
    button("Startup").click();
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Active) && says("Startup: Done"); }));
    window.open("/controller");
    EXPECT_TRUE(says("read-only: take control of /controller")) << "it is beside what is held";
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_TRUE(comes([this] { return window.control().text() == "Read-only; Stop works"; }));
    EXPECT_TRUE(comes([] { return leases().find("/drive") == std::string::npos; }));
    EXPECT_TRUE(isIn("/drive", State::Active)) << "releasing stops nothing";
}

TEST_F(Controlling, IsTakenByKeysAloneWithAFocusThatIsSeen) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
    ControlPanel* panel = window.control().panel();
    ASSERT_NE(panel, nullptr);
    const auto chosen = [&] {
        const auto all = panel->findChildren<QRadioButton*>();
        const auto found =
            std::ranges::find_if(all, [](const auto* each) { return each->isChecked(); });
        return found != all.end() ? *found : nullptr;
    };
    ASSERT_NE(chosen(), nullptr);
    EXPECT_EQ(panel->focusWidget(), chosen()) << "arrows choose at once";
    EXPECT_EQ(chosen()->text(), "/axis");
    QTest::keyClick(panel->focusWidget(), Qt::Key_Up);
    EXPECT_EQ(chosen()->text(), "/axis/observed");
    EXPECT_EQ(panel->takeButton().text(), "Take /axis/observed");
    QTest::keyClick(panel->focusWidget(), Qt::Key_Return);
    EXPECT_TRUE(comes([&] { return window.control().prefix() == "/axis/observed"; }));
}

TEST_F(Controlling, IsOfferedForTheRowOfTheTreeWhereTheViewShowsNoSimplex) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    window.openKind("agents");
    window.refresh();
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
    ASSERT_NE(window.control().panel(), nullptr);
    QStringList offered;
    for (const auto* each : window.control().panel()->findChildren<QRadioButton*>())
        offered << each->text();
    EXPECT_TRUE(offered.contains("/axis/observed")) << offered.join(' ').toStdString();
    EXPECT_TRUE(offered.contains("/axis"));
}

// The ring around it, in the colour of the accent.
TEST_F(Controlling, EveryWidgetOfThePanelShowsThatItHasTheFocus) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.control().choose();
    ControlPanel* panel = window.control().panel();
    QApplication::setActiveWindow(panel);
    QWidget* const first = panel->focusWidget();
    ASSERT_NE(first, nullptr);
    QSet<const QWidget*> seen;
    do {
        QWidget* const widget = panel->focusWidget();
        seen.insert(widget);
        const QImage with = widget->grab().toImage();
        widget->clearFocus();
        const QImage without = widget->grab().toImage();
        widget->setFocus(Qt::TabFocusReason);
        EXPECT_NE(with, without) << widget->metaObject()->className();
        QTest::keyClick(widget, Qt::Key_Tab);
    } while (panel->focusWidget() != first && seen.size() < 10);
    EXPECT_TRUE(seen.contains(&panel->takeButton()));
    QTest::keyClick(panel, Qt::Key_Escape);
    EXPECT_FALSE(panel->isVisible());
}

TEST(ScopeOfStop, IsWhatIsHeldAndNeverThePathAroundIt) {
    using Paths = std::vector<std::string>;
    EXPECT_EQ(widest({"/arm/left", "/arm/right/hand"}), (Paths{"/arm/left", "/arm/right/hand"}));
    EXPECT_EQ(widest({"/arm/left", "/arm", "/armature"}), (Paths{"/arm", "/armature"}));
    EXPECT_EQ(scopeWord({"/"}), "all");
    EXPECT_EQ(scopeWord({"/lift", "/zoo"}), "/lift and /zoo");
    EXPECT_EQ(scopeWord({"/lift", "/zoo", "/arm"}), "/lift and 2 more");
    EXPECT_EQ(scopeWords({"/lift", "/zoo", "/arm"}), "/lift and /zoo and /arm");
}

TEST_F(Controlling, AWindowThatHangsHoldsNothing) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(takes("/"));
    // No event is handled from here on, as in a window that hangs.
    EXPECT_TRUE(comesWithoutEvents([] {
        return test::live({"leases"}).output == "nobody holds control of anything of mixer\n";
    }));
    EXPECT_TRUE(comes([this] { return !window.control().holds(); }));
    EXPECT_TRUE(
        window.control().notice().text().startsWith("Control of / of agent mixer was lost: "))
        << window.control().notice().text().toStdString();
}

TEST_F(Controlling, StopsWhatIsHeldAtTheFirstPressOfF12) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(comes([] { return live({"call", "/mixer", "startup"}).exit == 0; }));
    ASSERT_TRUE(comes([this] { return isIn("/drive", State::Active); }));
    window.open("/controller");
    ASSERT_TRUE(takes("/controller"));
    window.refresh();
    EXPECT_EQ(window.stopButton().text(), "Stop /controller");
    window.open("/drive");
    EXPECT_EQ(window.stopButton().text(), "Stop /controller") << "it does not follow the selection";
    QTest::keyClick(&window, Qt::Key_F12);
    EXPECT_TRUE(comes([this] { return isIn("/controller", State::Standby); }));
    EXPECT_TRUE(comes([this] {
        return window.stopButton().progress().startsWith("All 1 of /controller in Standby, ");
    })) << window.stopButton().progress().toStdString();
    EXPECT_TRUE(isIn("/drive", State::Active));
}

// Everything runs, and the window holds /drive and what a colleague hands over to it.
class ControllingTwoParts : public Controlling {
protected:
    bool holdsDriveAnd(const std::string& prefix) {
        if (!everythingComes()) return false;
        EXPECT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
        const auto runs = [this] {
            return isIn("/drive", State::Active) && isIn("/controller", State::Active);
        };
        window.open("/drive");
        if (!comes(runs) || !takes("/drive")) return false;
        Colleague other;
        if (!comes([&] { return other.sees("/controller"); })) return false;
        other.control();
        other.session.takeControl(prefix);
        if (!comes([&] { return other.control().prefix == prefix; })) return false;
        other.session.handOver(session.frame()->control.self);
        const QString words = "Stop /drive and " + QString::fromStdString(prefix);
        return comes([&] {
            other.control();
            return window.stopButton().text() == words;
        });
    }
    bool tells(const QString& text) {
        return comes([&] { return window.stopButton().progress().startsWith(text); });
    }
};

TEST_F(ControllingTwoParts, StopsNothingBesideThemAtThePathAroundThem) {
    ASSERT_TRUE(holdsDriveAnd("/axis")) << window.stopButton().text().toStdString();
    QTest::keyClick(&window, Qt::Key_F12);
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Standby); }));
    EXPECT_TRUE(tells("All 1 of /drive and /axis in Standby, "))
        << window.stopButton().progress().toStdString();
    EXPECT_TRUE(isIn("/controller", State::Active));
}

TEST_F(ControllingTwoParts, StopsBothThoughTheirAgentDoesOneAtATime) {
    ASSERT_TRUE(holdsDriveAnd("/controller")) << window.stopButton().text().toStdString();
    QTest::keyClick(&window, Qt::Key_F12);
    EXPECT_TRUE(tells("All 2 of /drive and /controller in Standby, "))
        << window.stopButton().progress().toStdString();
    EXPECT_TRUE(isIn("/drive", State::Standby));
    EXPECT_TRUE(isIn("/controller", State::Standby));
}

TEST_F(Controlling, StartsAllOfASubtreeOnceControlOfItIsGiven) {
    ASSERT_TRUE(everythingComes());
    window.startAll().begin("/drive");
    EXPECT_TRUE(window.startAll().text().endsWith("needs control"));
    ASSERT_NE(window.control().panel(), nullptr);
    EXPECT_EQ(window.control().panel()->takeButton().text(), "Take /drive");
    EXPECT_TRUE(isIn("/drive", State::Standby));
    window.control().panel()->takeButton().click();
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Active); }));
    EXPECT_TRUE(comes([this] {
        return window.startAll().text().startsWith("All 1 of /drive Active, ");
    })) << window.startAll().text().toStdString();
    EXPECT_TRUE(isIn("/controller", State::Standby));
}

TEST_F(Controlling, WhoeverDeclinesControlStartsNothingLater) {
    ASSERT_TRUE(everythingComes());
    window.startAll().begin("/drive");
    window.control().panel()->close();
    EXPECT_TRUE(window.startAll().text().isEmpty());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    EXPECT_TRUE(isIn("/drive", State::Standby));
    EXPECT_TRUE(window.startAll().text().isEmpty());
}

TEST_F(Controlling, AStopEndsAStartThatStillWaits) {
    ASSERT_TRUE(everythingComes());
    window.startAll().begin("/drive");
    for (int press = 0; press < 2; ++press) QTest::mouseClick(&window.stopButton(), Qt::LeftButton);
    EXPECT_TRUE(window.startAll().text().isEmpty());
    window.control().panel()->takeButton().click();
    ASSERT_TRUE(comes([this] { return window.control().holds(); }));
    window.refresh();
    EXPECT_TRUE(window.startAll().text().isEmpty());
    EXPECT_TRUE(isIn("/drive", State::Standby));
}

TEST_F(Controlling, StopsAlwaysWhatAPersonChoseForIt) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(comes([] { return live({"call", "/mixer", "startup"}).exit == 0; }));
    ASSERT_TRUE(comes([this] { return isIn("/controller", State::Active); }));
    window.stopButton().setScope("/controller");
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    EXPECT_EQ(window.stopButton().text(), "Stop always /controller");
    QTest::mouseClick(&window.stopButton(), Qt::LeftButton);
    EXPECT_EQ(window.stopButton().text(), "Again: stop /controller") << "it is not controlled";
    EXPECT_TRUE(window.stopButton().progress().isEmpty());
    QTest::mouseClick(&window.stopButton(), Qt::LeftButton);
    EXPECT_TRUE(comes([this] { return isIn("/controller", State::Standby); }));
    EXPECT_TRUE(isIn("/drive", State::Active));
    window.stopButton().setScope(std::nullopt);
    window.refresh();
    EXPECT_EQ(window.stopButton().text(), "Stop /drive");
}

TEST_F(Controlling, TheMenuOfARowChoosesNothingAndSpeaksOfItsPath) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    auto* rows = window.tree().findChild<QTreeView*>();
    const QModelIndex row = window.tree().model().indexOf("/controller");
    ASSERT_TRUE(row.isValid());
    const QPoint at = rows->visualRect(row).center();
    QTest::mouseClick(rows->viewport(), Qt::RightButton, Qt::NoModifier, at);
    EXPECT_EQ(window.tree().model().path(rows->currentIndex()), "/drive");
    Q_EMIT rows->customContextMenuRequested(at);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    QStringList entries;
    for (const QAction* each : menu->actions()) entries << each->text();
    EXPECT_TRUE(entries.contains("Start all of /controller")) << entries.join('|').toStdString();
    EXPECT_TRUE(entries.contains("Stop all of /controller"));
    menu->close();
}

TEST_F(Controlling, AsksBeforeItIsClosed) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(takes("/"));
    const auto answer = [this](const char* text) {
        EXPECT_FALSE(window.close());
        const auto all = window.findChildren<Question*>();
        const auto found =
            std::ranges::find_if(all, [](const auto* each) { return each->isVisible(); });
        ASSERT_NE(found, all.end());
        Question* question = *found;
        EXPECT_EQ(question->accessibleName(), "Release everything and quit?");
        EXPECT_FALSE(window.close());
        EXPECT_EQ(window.findChildren<Question*>().size(), all.size()) << "it is asked once";
        for (auto* each : question->findChildren<QPushButton*>()) {
            if (each->text() == text) return each->click();
        }
        FAIL() << "no such button";
    };
    answer("Stay");
    EXPECT_TRUE(window.isVisible());
    answer("Quit");
    EXPECT_FALSE(window.isVisible());
}

TEST_F(Controlling, AFormSendsItsCommandAndSaysWhatBecameOfIt) {
    ASSERT_TRUE(everythingComes());
    window.open("/mixer");
    window.refresh();
    CommandCard& startup = card("startup");
    auto* run = startup.findChild<QPushButton*>();
    EXPECT_FALSE(run->isEnabled());
    ASSERT_TRUE(takes("/"));
    window.refresh();
    ASSERT_TRUE(run->isEnabled());
    EXPECT_FALSE(card("takeControl").findChild<QPushButton*>()->isEnabled());
    startup.findChild<ValueField*>()->setText("/drive");
    QTest::keyClick(&startup, Qt::Key_Return, Qt::ControlModifier);
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Active); }));
    const auto told = [&](const QString& text) {
        const auto labels = startup.findChildren<QLabel*>();
        return std::ranges::any_of(labels,
                                   [&](const auto* each) { return each->text().startsWith(text); });
    };
    EXPECT_TRUE(comes([&] { return told("Done  "); }));
    EXPECT_TRUE(isIn("/controller", State::Standby));
}

TEST_F(Controlling, AFormOfAKilledAgentSaysThatTheCommandMayHaveBeenExecuted) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    agent->end(SIGKILL);
    button("Startup").click();
    EXPECT_TRUE(comes([this] { return says("The command may have been executed."); }));
    EXPECT_TRUE(comes([this] { return says("mixer is not heard"); }));
    EXPECT_TRUE(comes([this] { return !window.control().holds(); }));
}

}  // namespace
}  // namespace cortex::test
