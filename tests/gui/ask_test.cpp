// SPDX-License-Identifier: Apache-2.0
// Control between people: two windows that see each other, ask, refuse and hand over.
#include "gui/controlling.hpp"
#include "gui/made_agent.hpp"
#include "gui/places.hpp"
#include "model/holders.hpp"

#include <QApplication>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

// The window of the test is Ben's, the other one Maria's.
class TwoWindows : public Controlling {
protected:
    struct Other {
        Session session{ownNetwork(), "maria"};
        MainWindow window{session};
    };

    bool bothSee() {
        other.window.show();
        return everythingComes() && comes([this] {
                   return other.window.ready() && !mine().tools.empty() && !theirs().tools.empty();
               });
    }
    Control mine() const { return session.frame()->control; }
    Control theirs() const { return other.session.frame()->control; }
    QString maria() const { return "maria (" + QString::fromStdString(theirs().self) + ")"; }
    QString me() const { return wholeNameOf(theirs(), mine().self); }
    bool otherTakes(const std::string& prefix) {
        other.session.takeControl(prefix);
        return comes([&] { return other.window.control().prefix() == prefix; }) &&
               comes([&] { return !holdersAt(*session.frame(), prefix).empty(); });
    }
    ControlNotice& myNotice() { return window.control().notice(); }
    ControlNotice& otherNotice() { return other.window.control().notice(); }
    bool iRead(const QString& text) {
        return comes([&] { return myNotice().text() == text; });
    }
    bool otherReads(const QString& text) {
        return comes([&] { return otherNotice().text() == text; });
    }
    // By the button of the popover.
    void ask(const std::string& prefix) {
        window.control().choose(prefix);
        window.refresh();
        QTest::mouseClick(&window.control().panel()->askButton(), Qt::LeftButton);
    }
    bool isAskedFor(const QString& scope) {
        const QString gives = scope == "/drive" ? "" : " Hand over gives /drive.";
        return otherReads(me() + " asks for " + scope + "." + gives);
    }
    HandOverPanel& openHandOver() {
        window.control().chooseHandOver();
        return *window.control().handOverPanel();
    }
    static void clickRow(HandOverPanel& panel, int row) {
        const QRect place = panel.others().visualItemRect(panel.others().item(row));
        QTest::mouseClick(panel.others().viewport(), Qt::LeftButton, {}, place.center());
    }

    Other other;
};

TEST_F(TwoWindows, SeeEachOtherByTheNamesOfPeopleBeforeTheyHoldAnything) {
    ASSERT_TRUE(bothSee());
    EXPECT_EQ(mine().tools.front().person, "maria");
    EXPECT_EQ(mine().tools.front().name, theirs().self);
    EXPECT_EQ(theirs().tools.front().person, mine().person);
    EXPECT_TRUE(mine().held.empty() && theirs().held.empty());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    const HandOverPanel& panel = openHandOver();
    EXPECT_EQ(panel.whyNobody(), "");
    ASSERT_EQ(panel.offered(), QStringList{QString::fromStdString(theirs().self)});
    QString said;
    for (const auto* each : panel.findChildren<QLabel*>()) said += each->text() + '\n';
    EXPECT_TRUE(said.contains("A click, or Enter twice, hands over /drive to:"))
        << said.toStdString();
    EXPECT_TRUE(said.contains("To others you are " + ownName(mine()) + "."));
}

TEST_F(TwoWindows, HandOverByTwoClicksAllThatIsHeld) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(otherTakes("/controller"));
    ASSERT_TRUE(takes("/drive"));
    other.session.handOver(mine().self);
    ASSERT_TRUE(comes([this] { return mine().held.size() == 2; }));
    window.refresh();
    EXPECT_EQ(window.control().text(), "You control /drive and /controller") << "no time of both";
    EXPECT_TRUE(window.control().toolTip().contains("; /controller since "));
    HandOverPanel& panel = openHandOver();
    ASSERT_EQ(panel.others().count(), 1);
    EXPECT_EQ(panel.others().item(0)->text(), maria());
    clickRow(panel, 0);
    EXPECT_TRUE(comes([this] { return theirs().held.size() == 2 && mine().held.empty(); }));
    EXPECT_TRUE(iRead("Control of /controller and /drive was handed over to " + maria() + "."))
        << myNotice().text().toStdString();
}

TEST_F(TwoWindows, AKeyHandsOverOnlyWhatAnArrowHasChosen) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    HandOverPanel& panel = openHandOver();
    QTest::keyClick(&panel.others(), Qt::Key_Return);
    EXPECT_TRUE(panel.isVisible());
    QTest::keyClick(&panel.others(), Qt::Key_Down);
    QTest::keyClick(&panel.others(), Qt::Key_Return);
    EXPECT_FALSE(panel.isVisible());
    EXPECT_TRUE(comes([this] { return theirs().prefix == "/drive"; }));
}

TEST_F(TwoWindows, WhoIsAskedHandsOverAndBothReadIt) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(otherTakes("/drive"));
    EXPECT_TRUE(comes([this] { return says("held by maria since "); }));
    other.window.refresh();
    const Places before = placesIn(other.window);
    ask("/drive");
    EXPECT_TRUE(comes([this] { return window.control().text() == "Asking maria for /drive"; }));
    EXPECT_EQ(myNotice().text(), "Asking " + maria() + " for /drive.");
    EXPECT_EQ(myNotice().remedy().text(), "Withdraw");
    ASSERT_TRUE(isAskedFor("/drive")) << otherNotice().text().toStdString();
    EXPECT_EQ(movedSince(before, other.window), "");
    EXPECT_TRUE(other.window.control().toolTip().contains(" asks for /drive"));
    QTest::keyClick(&other.window, Qt::Key_Escape);
    Q_EMIT otherNotice().closed();
    other.window.refresh();
    EXPECT_TRUE(isAskedFor("/drive")) << "it is closed by an answer only";
    ASSERT_EQ(otherNotice().remedy().text(), "Hand over");
    otherNotice().remedy().click();
    otherNotice().remedy().click();
    EXPECT_TRUE(comes([this] { return mine().prefix == "/drive" && theirs().held.empty(); }));
    EXPECT_TRUE(otherReads("Control of /drive was handed over to " + me() + "."));
    EXPECT_TRUE(iRead("Control of /drive of agent mixer is yours now."));
    EXPECT_TRUE(mine().asking.prefix.empty());
}

TEST_F(TwoWindows, WhoAsksReadsThatItWasRefused) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(otherTakes("/drive"));
    window.control().choose("/");
    window.control().panel()->takeButton().click();
    ASSERT_TRUE(iRead("Control of / was not taken. mixer: " + maria() +
                      " holds /drive, and must release it or hand it over."))
        << myNotice().text().toStdString();
    ASSERT_TRUE(comes([this] { return myNotice().remedy().text() == "Ask maria for it"; }));
    myNotice().remedy().click();
    ASSERT_TRUE(isAskedFor("everything")) << otherNotice().text().toStdString();
    otherNotice().refuse().click();
    EXPECT_TRUE(iRead("Control of / was refused to you by " + maria() + "."))
        << myNotice().text().toStdString();
    EXPECT_TRUE(otherReads(""));
    EXPECT_EQ(theirs().prefix, "/drive");
    EXPECT_EQ(window.control().text(), "Read-only; Stop works");
}

TEST_F(TwoWindows, WhatIsWithdrawnIsAskedNoMoreAndWhatWasSaidBeforeComesBack) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(otherTakes("/drive"));
    other.session.takeControl("/nowhere");
    const QString before =
        "Nothing was taken: nobody who is heard has anything at or below /nowhere.";
    ASSERT_TRUE(otherReads(before));
    ask("/drive");
    ASSERT_TRUE(isAskedFor("/drive"));
    ASSERT_TRUE(comes([this] { return !myNotice().remedy().isHidden(); }));
    myNotice().remedy().click();
    EXPECT_TRUE(otherReads(before));
    EXPECT_TRUE(iRead(""));
    EXPECT_EQ(window.control().text(), "Read-only; Stop works");
}

TEST_F(TwoWindows, WhatIsReleasedWhileItIsAskedForIsOffered) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(otherTakes("/drive"));
    ask("/drive");
    ASSERT_TRUE(isAskedFor("/drive"));
    other.window.control().release();
    EXPECT_TRUE(iRead("Nobody else holds a part of /drive now, so it can be taken."))
        << myNotice().text().toStdString();
    ASSERT_TRUE(comes([this] { return myNotice().remedy().text() == "Take /drive"; }));
    myNotice().remedy().click();
    EXPECT_TRUE(comes([this] { return window.control().prefix() == "/drive"; }));
}

TEST_F(TwoWindows, WhatIsReleasedAndTakenAtOnceIsTakenAnew) {
    ASSERT_TRUE(bothSee());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    const std::int64_t since = mine().since;
    session.releaseControl();
    session.takeControl("/drive");
    EXPECT_TRUE(comes([&] { return mine().since > since && mine().prefix == "/drive"; }));
}

TEST_F(TwoWindows, WhatIsTakenWhileSomethingElseIsTakenIsTakenAfterIt) {
    ASSERT_TRUE(bothSee());
    session.takeControl("/drive");
    session.takeControl("/controller");
    EXPECT_TRUE(
        comes([this] { return mine().prefixes() == std::vector<std::string>{"/controller"}; }));
    session.takeControl("/drive");
    session.releaseControl();
    EXPECT_TRUE(comes([this] { return mine().asks.empty() && mine().held.empty(); }));
}

// It holds something, and no person uses it.
TEST_F(Controlling, WhoDoesNotSayWhoUsesItCannotBeAskedAndThatIsSaid) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    comms::Mirror mirror{"program", ownNetwork()};
    ASSERT_TRUE(comes([&] { return mirror.structure("mixer") != nullptr; }));
    comms::LeaseClient leases{mirror};
    leases.take("/drive", {"mixer"});
    const QString name = QString::fromStdString(mirror.name());
    EXPECT_TRUE(comes([&] { return says("held by " + name); }));
    window.control().choose("/drive");
    ControlPanel& panel = *window.control().panel();
    EXPECT_TRUE(panel.askButton().isHidden());
    QString said;
    for (const auto* each : panel.findChildren<QLabel*>()) said += each->text();
    EXPECT_TRUE(said.contains("Who does not say who uses it cannot be asked: " + name + "."))
        << said.toStdString();
    panel.takeButton().click();
    const ControlNotice& notice = window.control().notice();
    EXPECT_TRUE(comes([&] {
        return notice.text().endsWith(name + " cannot be asked, as it does not say who uses it.");
    })) << notice.text().toStdString();
    EXPECT_TRUE(window.control().notice().remedy().isHidden());
}

// Made by hand: what is said of control of one agent, /mixer, that somebody else may hold.
class SaidOfControl : public testing::Test {
protected:
    SaidOfControl() {
        frame->control.self = "cortex-explorer@here.1-5e1f0a";
        frame->control.person = "ben";
        frame->control.told = 1;
    }
    static comms::ToolStatus tool(const std::string& name, const std::string& person) {
        comms::ToolStatus made;
        made.name = name;
        made.person = person;
        return made;
    }
    const ControlNews::Row& now() {
        frame->agents = {mixer.now()};
        news.refresh(*frame);
        return news.row();
    }
    void isHeldBy(const std::string& holder) {
        giveLease(mixer, "/mixer", holder.empty() ? "" : "/mixer", holder);
    }

    MadeAgent mixer{"mixer", [](SimplexTree& tree) { tree.add("/mixer", "Cluster"); }};
    std::shared_ptr<Frame> frame = frameOf({});
    ControlNews news;
};

TEST_F(SaidOfControl, ARefusalSaysWhoHoldsItAlsoWhereThatIsShownLater) {
    frame->control.notice = "Control of / was not taken.";
    frame->control.refused = "/";
    frame->control.refusals = {{"mixer", "Rejected (authority): anna holds /mixer"}};
    frame->control.tools = {tool("anna@desk.1-1", "anna")};
    EXPECT_EQ(now().text,
              "Control of / was not taken. mixer: Rejected (authority): anna holds /mixer.");
    EXPECT_EQ(now().remedy, "");
    isHeldBy("anna@desk.1-1");
    EXPECT_EQ(now().text,
              "Control of / was not taken. mixer: anna (anna@desk.1-1) holds /mixer, and must "
              "release it or hand it over.");
    EXPECT_EQ(now().remedy, "Ask anna for it");
    isHeldBy("");
    EXPECT_EQ(now().text, "Control of / was not taken. Nobody else holds a part of it any longer.");
    EXPECT_EQ(now().remedy, "Take everything");
    news.close();
    EXPECT_EQ(now().text, "");
    ++frame->control.told;
    EXPECT_NE(now().text, "") << "it is refused once more";
}

TEST_F(SaidOfControl, TheLongestAskIsAnsweredFirstAndTheOthersAreCounted) {
    frame->control.notice = "Control of /mixer of agent mixer is yours now.";
    frame->control.tools = {tool("anna@desk.1-1", "anna"), tool("carl@desk.2-2", "carl")};
    frame->control.asked = {{"carl@desk.2-2", "carl", "/mixer", 3, {{"mixer", "/", 1}}},
                            {"anna@desk.1-1", "anna", "/mixer", 1, {{"mixer", "/", 1}}}};
    EXPECT_EQ(now().text,
              "carl (carl@desk.2-2) asks for /mixer. Hand over gives everything of mixer. 1 more "
              "asks.");
    news.close();
    EXPECT_EQ(now().act, ControlNews::Act::Grant) << "only an answer ends it";
    frame->control.asked.erase(frame->control.asked.begin());
    EXPECT_TRUE(now().text.startsWith("anna (anna@desk.1-1) asks for /mixer."));
    const auto asked = std::exchange(frame->control.asked, {});
    EXPECT_EQ(now().text, "Control of /mixer of agent mixer is yours now.");
    news.close();
    frame->control.asked = asked;
    now();
    news.close();
    frame->control.asked.clear();
    EXPECT_EQ(now().text, "") << "that was read";
}

TEST_F(SaidOfControl, APressThatIsMeantForOnePersonAnswersNobodyElse) {
    Session session{ownNetwork()};
    ControlBar bar{session};
    ControlNotice& notice = bar.notice();
    const auto letsTheMouseThrough = [&] {
        bar.refresh(frame, "");
        return notice.testAttribute(Qt::WA_TransparentForMouseEvents);
    };
    frame->control.asked = {{"anna@desk.1-1", "anna", "/mixer", 1, {{"mixer", "/", 1}}}};
    EXPECT_TRUE(letsTheMouseThrough());
    notice.setAttribute(Qt::WA_TransparentForMouseEvents, false);
    EXPECT_FALSE(letsTheMouseThrough()) << "it is the same question";
    frame->control.asked = {{"carl@desk.2-2", "carl", "/mixer", 1, {{"mixer", "/", 1}}}};
    EXPECT_TRUE(letsTheMouseThrough());
}

TEST_F(SaidOfControl, APersonOfWhomThereAreTwoIsCalledByTheNameOfTheTool) {
    Control& control = frame->control;
    control.tools = {tool("anna@desk.1-1", "anna")};
    EXPECT_EQ(shortNameOf(control, "anna@desk.1-1"), "anna");
    control.tools.push_back(tool("anna@hall.7-7", "anna"));
    EXPECT_EQ(shortNameOf(control, "anna@desk.1-1"), "anna@desk.1-1");
    control.tools = {tool("ben@desk.1-1", "ben")};
    EXPECT_EQ(shortNameOf(control, "ben@desk.1-1"), "ben@desk.1-1") << "this window is Ben's, too";
}

TEST_F(SaidOfControl, NoNameTurnsMarksUpOrBreaksWhatIsSaid) {
    const std::string hostile = "<b>eve</b>\u202e\u2066 %1 %2 & co";
    const QString shownAs = "<b>eve</b>\\u202e\\u2066 %1 %2 & co";
    Control& control = frame->control;
    control.tools = {tool("eve@desk.1-1", hostile)};
    control.asked = {{"eve@desk.1-1", hostile, "/mixer", 1, {{"mixer", "/mixer", 1}}}};
    EXPECT_EQ(now().text, shownAs + " (eve@desk.1-1) asks for /mixer.");
    isHeldBy("eve@desk.1-1");
    now();
    EXPECT_EQ(askText(*frame, "/"), "Ask <b>eve</b>\\u202e\\u2…");
    control.tools.front().person = "\u05e9\u05e8\u05d4";
    EXPECT_EQ(shortNameOf(control, "eve@desk.1-1"), QString{"\u2068\u05e9\u05e8\u05d4\u2069"})
        << "it stays between the words beside it";
    control.tools.front().person = std::string(63, 'W');
    now();
    HandOverPanel handOver{frame};
    EXPECT_EQ(handOver.others().item(0)->text(), QString(63, 'W') + " (eve@desk.1-1)");
    const ControlPanel panel{frame, "/mixer"};
    EXPECT_LE(panel.askButton().fontMetrics().horizontalAdvance(panel.askButton().text()),
              panel.askButton().width());
    for (const auto* each : panel.findChildren<QLabel*>())
        EXPECT_EQ(each->textFormat(), Qt::PlainText);
}

}  // namespace
}  // namespace cortex::test
