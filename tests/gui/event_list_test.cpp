// SPDX-License-Identifier: Apache-2.0
// The views of events follow the newest, and say what they no longer have.
#include "gui/event_views.hpp"
#include "gui/waiting.hpp"
#include "views/event_panel.hpp"

#include <QFile>
#include <QKeyEvent>
#include <QTemporaryDir>
#include <QTimer>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

// The row under the pointer, by its serial number.
std::uint64_t underPointer(const EventTable& rows, const EventFilter& events) {
    QApplication::processEvents();
    return events.serial(rows.indexAt(rows.viewport()->mapFromGlobal(QCursor::pos())).row());
}

void enter(EventTable& rows) {
    QTest::mouseMove(rows.viewport(), {50, 40});
    QEvent enter{QEvent::Enter};
    QApplication::sendEvent(rows.window(), &enter);
}

void leave(EventTable& rows, QWidget& forWhat) {
    QTest::mouseMove(&forWhat, {50, 5});
    QEvent leave{QEvent::Leave};
    QApplication::sendEvent(&rows, &leave);
}

TEST_F(Events, FollowAgainAfterTheSelectedRowDroppedOut) {
    events.add(changes(1, events.kept()));
    rows().setCurrentIndex(rows().model()->index(0, 0));
    rows().scrollToBottom();
    ASSERT_TRUE(isAtTheEnd(rows()));
    events.add(changes(events.kept() + 1, 10));
    EXPECT_TRUE(isAtTheEnd(rows()));
    EXPECT_FALSE(rows().currentIndex().isValid()) << "nothing else is selected by itself";
}

TEST_F(Events, SayHowManyAreNoLongerKept) {
    events.add(changes(1, events.kept()));
    EXPECT_FALSE(says(list, "no longer kept"));
    events.add(changes(events.kept() + 1, 1'010));
    EXPECT_TRUE(says(list, "1,010 older ones are no longer kept"));
}

TEST_F(Events, TheStripSaysHowManyAreNewAndGoesToThemAtAPress) {
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(rows()));
    const QRect place = rows().geometry();
    scrollUp(rows());
    EXPECT_EQ(buttonIn(list, "3 new"), nullptr);
    events.add(changes(201, 3));
    ASSERT_NE(buttonIn(list, "3 new"), nullptr);
    EXPECT_FALSE(isAtTheEnd(rows())) << "what is looked at stays";
    EXPECT_EQ(rows().geometry(), place) << "no row moves when the button comes";
    buttonIn(list, "3 new")->click();
    EXPECT_TRUE(isAtTheEnd(rows()));
    EXPECT_EQ(buttonIn(list, "3 new"), nullptr);
    events.add(changes(204, 3));
    EXPECT_TRUE(isAtTheEnd(rows()));
}

TEST_F(Events, TheStripFollowsAgainOnceItIsLeft) {
    events.add(changes(1, 200));
    auto* left = list.findChild<QTimer*>({}, Qt::FindDirectChildrenOnly);
    ASSERT_NE(left, nullptr);
    left->setInterval(0);
    QEvent enter{QEvent::Enter}, leave{QEvent::Leave};
    QApplication::sendEvent(&list, &enter);
    scrollUp(rows());
    for (int i = 0; i < 50; ++i) QApplication::processEvents();
    EXPECT_FALSE(isAtTheEnd(rows())) << "the pointer is in it";
    QApplication::sendEvent(&list, &leave);
    if (QWidget* focused = QApplication::focusWidget()) focused->clearFocus();
    EXPECT_TRUE(comes([this] { return rows().follows(); }));
    EXPECT_TRUE(isAtTheEnd(rows()));
}

TEST_F(Events, StandStillUnderThePointerAndFollowAgainWhenItLeaves) {
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(rows()));
    enter(rows());
    const auto row = underPointer(rows(), shown);
    events.add(changes(201, 3));
    EXPECT_EQ(underPointer(rows(), shown), row);
    EXPECT_NE(buttonIn(list, "3 new"), nullptr);
    leave(rows(), list);
    EXPECT_TRUE(isAtTheEnd(rows()));
    EXPECT_EQ(buttonIn(list, "3 new"), nullptr);
    events.add(changes(204, 3));
    EXPECT_TRUE(isAtTheEnd(rows()));
}

TEST_F(Events, StandStillUnderThePointerAlsoWhileTheOldestGo) {
    events.add(changes(1, events.kept()));
    ASSERT_TRUE(isAtTheEnd(rows()));
    enter(rows());
    const auto row = underPointer(rows(), shown);
    events.add(changes(events.kept() + 1, 10));
    EXPECT_EQ(underPointer(rows(), shown), row);
    events.add(changes(events.kept() + 11, 10));
    EXPECT_EQ(underPointer(rows(), shown), row);
}

TEST_F(Events, TheFirstStepOfAKeyIsFromWhatIsInSight) {
    events.add(changes(1, 200));
    QKeyEvent down{QEvent::KeyPress, Qt::Key_Down, Qt::NoModifier};
    QApplication::sendEvent(&rows(), &down);
    EXPECT_EQ(rows().currentIndex().row(), 199);
    EXPECT_TRUE(rows().follows()) << "it was not scrolled up";
}

TEST_F(EventTab, SaysHowManyAreNewBelowWhileSomebodyLooksFurtherUp) {
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(table()));
    EXPECT_EQ(button("new below"), nullptr);
    table().verticalScrollBar()->triggerAction(QScrollBar::SliderToMinimum);
    table().setCurrentIndex(table().model()->index(2, 0));
    const auto selected = table().selected();
    events.add(changes(201, 12));
    view.refresh();
    ASSERT_NE(button("12 new below"), nullptr);
    EXPECT_EQ(table().verticalScrollBar()->value(), 0) << "what is looked at stays";
    EXPECT_EQ(table().selected(), selected);
    QKeyEvent end{QEvent::KeyPress, Qt::Key_End, Qt::NoModifier};
    QApplication::sendEvent(&table(), &end);
    EXPECT_TRUE(isAtTheEnd(table()));
    EXPECT_EQ(table().selected(), selected);
    EXPECT_EQ(button("new below"), nullptr);
    events.add(changes(213, 5));
    EXPECT_TRUE(isAtTheEnd(table())) << "it follows again";
}

TEST_F(EventTab, StandsStillUnderThePointerAndFollowsAgainWhenItLeaves) {
    list.hide();
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(table()));
    enter(table());
    const auto row = underPointer(table(), shown);
    events.add(changes(201, 12));
    EXPECT_EQ(underPointer(table(), shown), row);
    QPushButton* below = button("12 new below");
    ASSERT_NE(below, nullptr);
    QTest::mouseMove(below, below->rect().center());
    events.add(changes(213, 1));
    EXPECT_EQ(button("new below"), below) << "it does not go where it is about to be pressed";
    EXPECT_EQ(below->text(), "13 new below");
    enter(table());
    EXPECT_EQ(underPointer(table(), shown), row);
    leave(table(), view);
    EXPECT_TRUE(isAtTheEnd(table()));
    EXPECT_EQ(button("new below"), nullptr);
}

// All rows of the window's own have number 0.
TEST_F(EventTab, ShowsTheDetailsOfTheRowThatIsChosen) {
    const comms::AgentEvent lost = eventOf(0, "agent lost", "", "robot is not heard");
    comms::AgentEvent heard = eventOf(0, "agent heard", "", "robot is heard again");
    heard.wallClock = lost.wallClock + 1;
    events.add({lost, heard});
    table().setCurrentIndex(table().model()->index(0, 0));
    view.refresh();
    EXPECT_TRUE(says(view, "robot is not heard"));
    table().setCurrentIndex(table().model()->index(1, 0));
    view.refresh();
    EXPECT_TRUE(says(view, "robot is heard again"));
}

TEST(EventDetails, HaveACommandForAShellThatSeesTheSameNetwork) {
    comms::NetworkOptions network;
    network.domain = 7;
    network.interfaces = {"eth0"};
    network.peers = {"far station"};
    network.discoveryServer.clear();
    network.security.clear();
    EventPanel panel{network};
    panel.show(EventRow{eventOf(1, "fault", "/a b", "broken", Severity::Error)}, 3);
    EXPECT_TRUE(says(panel,
                     "As a command: cortex events '/a b' --before-fault --until "
                     "1970-01-01T00:00:01Z --domain 7 --interface eth0 --peer 'far station'"));
}

TEST_F(EventTab, HasTheFilterOfTheStripAndSaysHowMuchItShows) {
    events.add(changes(1, 10));
    events.add({limit(11, "position limited"),
                eventOf(12, "fault", "/drives/1", "Fault 0x8611", Severity::Error)});
    type("in:/drives");
    EXPECT_EQ(table().model()->rowCount(), 11);
    EXPECT_EQ(rows().model()->rowCount(), 11);
    EXPECT_TRUE(says(view, "11 of 12 shown"));
    EXPECT_TRUE(says(list, "in:/drives"));
    ASSERT_NE(chip("state change 10"), nullptr);
    EXPECT_EQ(chip("limit 1"), nullptr) << "chips count what matches";
    chip("state change 10")->click();
    view.refresh();
    EXPECT_NE(chip("state change 10 hidden"), nullptr) << "its number stays";
    EXPECT_TRUE(says(view, "1 of 12 shown"));
    EXPECT_TRUE(says(list, "in:/drives, without state change"));
    ASSERT_NE(chip("error 1"), nullptr);
    chip("error 1")->click();
    EXPECT_EQ(table().model()->rowCount(), 0);
    type("nonsense:1");
    EXPECT_TRUE(says(view, "\"nonsense:\" is no field."));
}

TEST_F(EventTab, AKindIsFoundAsTheCommandLineSpellsItAndAWrongOneIsNamed) {
    events.add(changes(1, 10));
    type("kind:state-change");
    EXPECT_EQ(table().model()->rowCount(), 10);
    type("kind:comand");
    EXPECT_TRUE(says(view, "\"kind:comand\" is no kind."));
}

TEST_F(EventTab, NoFilterHidesAFaultUnsaidAndTheStripTakesItAway) {
    events.add(changes(1, 10));
    type("in:/drives");
    chip("error 0")->click();
    EXPECT_FALSE(says(list, "not shown"));
    events.add({eventOf(11, "fault", "/drives/1", "Fault 0x8611", Severity::Error),
                eventOf(12, "message", "/b", "it broke", Severity::Error)});
    EXPECT_TRUE(says(list, "2 faults or errors not shown"));
    EXPECT_TRUE(says(list, "10 of 12 shown"));
    view.refresh();
    EXPECT_TRUE(says(view, "10 of 12 shown; 2 faults or errors not shown"));
    ASSERT_NE(buttonIn(list, "Show all"), nullptr);
    buttonIn(list, "Show all")->click();
    view.refresh();
    EXPECT_FALSE(says(list, "not shown"));
    EXPECT_EQ(buttonIn(list, "Show all"), nullptr);
    EXPECT_EQ(rows().model()->rowCount(), 12);
    EXPECT_EQ(view.findChild<QLineEdit*>()->text(), "");
    EXPECT_NE(chip("error 2"), nullptr) << "it is no longer off";
}

TEST_F(EventTab, AViewThatIsOpenedAnewShowsTheFilterThatIsOn) {
    events.add(changes(1, 10));
    type("nonsense:1");
    const EventView another{shown, {}};
    EXPECT_EQ(another.findChild<QLineEdit*>()->text(), "nonsense:1");
    EXPECT_TRUE(says(another, "\"nonsense:\" is no field."));
    EXPECT_TRUE(says(another, "0 of 10 shown"));
}

TEST_F(EventTab, TheStripCountsAlsoWhatTheFilterHides) {
    events.add(changes(1, 10));
    type("in:/nowhere");
    EXPECT_TRUE(says(list, "0 of 10 shown"));
    events.add(changes(11, 5));
    EXPECT_TRUE(says(list, "0 of 15 shown"));
}

TEST_F(EventTab, CountsAsNewBelowOnlyWhatTheFilterShows) {
    events.add(changes(1, 200));
    scrollUp(table());
    events.add(changes(201, 6));
    events.add({limit(207, "limited to 1")});
    ASSERT_NE(button("7 new below"), nullptr);
    type("nothing has this");
    EXPECT_EQ(button("new below"), nullptr);
    type("kind:limit");
    EXPECT_NE(button("1 new below"), nullptr);
    type("");
    EXPECT_NE(button("7 new below"), nullptr);
}

TEST_F(EventTab, TheDetailsGoWithARowThatTheFilterHides) {
    events.add({limit(1, "position limited from -2.5 to -2 rad")});
    events.add(changes(2, 3));
    table().setCurrentIndex(table().model()->index(0, 0));
    ASSERT_TRUE(says(view, "/arm/demands/4"));
    ASSERT_NE(button("Show in tree"), nullptr);
    type("nothing has this");
    EXPECT_FALSE(says(view, "/arm/demands/4"));
    EXPECT_TRUE(says(view, "Choose an event."));
    EXPECT_EQ(button("Show in tree"), nullptr);
    type("");
    table().setCurrentIndex(table().model()->index(0, 0));
    EXPECT_TRUE(says(view, "/arm/demands/4"));
}

TEST_F(EventTab, ShowsTheDetailsOfTheSelectedRowAlsoWhenItDropsOut) {
    events.add({limit(1, "position limited from -2.5 to -2 rad"),
                limit(2, "position limited from -2.25 to -2 rad")});
    table().setCurrentIndex(table().model()->index(0, 0));
    EXPECT_TRUE(says(view, "/arm/demands/4"));
    EXPECT_TRUE(says(view, QString::fromUtf8("−2.5 … −2.25, last -2.25")));
    EXPECT_TRUE(says(view, "2 in 0.0 s"));
    events.add({limit(3, "position limited from -2.75 to -2 rad")});
    view.refresh();
    EXPECT_TRUE(says(view, "3 in 0.0 s")) << "they go on";
    events.add(changes(4, events.kept()));
    view.refresh();
    EXPECT_TRUE(says(view, "no longer kept"));
    EXPECT_TRUE(says(view, "/arm/demands/4"));
}

TEST_F(EventTab, OpensARowOfManyByTheRightArrowAndClosesItByTheLeftOne) {
    events.add({limit(1, "limited to 1"), limit(2, "limited to 2"),
                eventOf(3, "message", "/b", "something else")});
    table().setCurrentIndex(table().model()->index(0, 0));
    const auto press = [&](Qt::Key key) {
        QKeyEvent event{QEvent::KeyPress, key, Qt::NoModifier};
        QApplication::sendEvent(&table(), &event);
    };
    press(Qt::Key_Right);
    EXPECT_EQ(table().model()->rowCount(), 4);
    EXPECT_EQ(table().currentIndex().row(), 0);
    press(Qt::Key_Down);
    EXPECT_EQ(table().currentIndex().row(), 1);
    press(Qt::Key_Left);
    EXPECT_EQ(table().model()->rowCount(), 2);
    EXPECT_EQ(table().currentIndex().row(), 0) << "of the row that was open";
}

TEST_F(EventTab, DownAndEnterInItsFilterGoToTheNewestRowAndUpInTheFirstGoesBack) {
    auto& field = *view.findChild<QLineEdit*>();
    QApplication::setActiveWindow(&view);
    events.add(changes(1, 200));
    for (const auto key : {Qt::Key_Down, Qt::Key_Return}) {
        view.focusFilter();
        table().setCurrentIndex({});
        ASSERT_TRUE(isAtTheEnd(table()));
        QTest::keyClick(&field, key);
        EXPECT_TRUE(table().hasFocus());
        EXPECT_GE(table().currentIndex().row(), table().model()->rowCount() - 2);
    }
    table().setCurrentIndex(table().model()->index(1, 0));
    view.focusFilter();
    QTest::keyClick(&field, Qt::Key_Down);
    EXPECT_EQ(table().currentIndex().row(), 1) << "to the one that is chosen";
    QTest::keyClick(&table(), Qt::Key_Up);
    EXPECT_TRUE(table().hasFocus());
    QTest::keyClick(&table(), Qt::Key_Up);
    EXPECT_TRUE(field.hasFocus());
}

TEST_F(EventTab, TheKeyboardThatComesChoosesNothingAndHomeTheFirst) {
    QApplication::setActiveWindow(&view);
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(table()));
    table().setFocus(Qt::TabFocusReason);
    EXPECT_FALSE(table().currentIndex().isValid());
    QTest::keyClick(&table(), Qt::Key_Down);
    EXPECT_GE(table().currentIndex().row(), 198) << "what is in sight";
    QTest::keyClick(&table(), Qt::Key_Home);
    EXPECT_EQ(table().currentIndex().row(), 0);
    EXPECT_EQ(table().verticalScrollBar()->value(), 0);
}

TEST_F(EventTab, AnEventThatIsOpenedAtTheEndHasNothingNewBelow) {
    events.add(changes(1, 200));
    ASSERT_TRUE(isAtTheEnd(table()));
    table().verticalScrollBar()->triggerAction(QScrollBar::SliderToMinimum);
    events.add(changes(201, 12));
    ASSERT_EQ(table().newBelow(), 12U);
    view.choose(shown.serial(211));
    EXPECT_TRUE(isAtTheEnd(table()));
    EXPECT_EQ(table().newBelow(), 0U);
    events.add(changes(213, 5));
    EXPECT_EQ(table().newBelow(), 5U) << "it stays in sight";
    EXPECT_EQ(table().currentIndex().row(), 211);
}

TEST_F(EventTab, WritesControlCharactersAsTheyAre) {
    const QTemporaryDir folder;
    const QString path = folder.filePath("events.csv");
    events.add({eventOf(1, "message", "/a", "two\r\nlines \x1b[31m")});
    view.exportTo(path);
    QFile file{path};
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_TRUE(file.readAll().endsWith(",message,/a,\"two\r\nlines \x1b[31m\"\n"));
}

TEST_F(EventTab, WritesWhatIsShownToAFileOrSaysWhyNot) {
    const QTemporaryDir folder;
    const QString path = folder.filePath("events.csv");
    events.add({limit(1, "from 1 to 2"), limit(2, "from 3 to 2"),
                eventOf(5, "message", "/a", "he said \"no\", twice")});
    view.exportTo(path);
    QFile file{path};
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(QString::fromUtf8(file.readAll()),
              "time,agent,number,cycle,severity,kind,path,text\n"
              "1970-01-01T00:00:00.001Z,robot,1,1,warning,limit,/arm/demands/4,\"from 1 to 2\"\n"
              "1970-01-01T00:00:00.002Z,robot,2,2,warning,limit,/arm/demands/4,\"from 3 to 2\"\n"
              "1970-01-01T00:00:00.002Z,robot,2,2,warning,missing,,"
              "\"2 events of robot did not come\"\n"
              "1970-01-01T00:00:00.005Z,robot,5,5,info,message,/a,"
              "\"he said \"\"no\"\", twice\"\n");
    EXPECT_TRUE(says(view, "Written: "));
    view.exportTo("/no/such/folder/events.csv");
    EXPECT_TRUE(says(view, "Not written: "));
}

}  // namespace
}  // namespace cortex::test
