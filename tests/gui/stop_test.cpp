// SPDX-License-Identifier: Apache-2.0
// The Stop button of the window, with a real agent over DDS.
#include "comms/secured_plant.hpp"
#include "gui/audit.hpp"
#include "gui/audit_texts.hpp"
#include "gui/rival.hpp"
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "widgets/question.hpp"
#include "widgets/text_label.hpp"
#include "window/stop_button.hpp"

#include <QElapsedTimer>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <functional>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Stopping : public Window {
protected:
    bool isIn(const std::string& path, State state) {
        const auto frame = session.frame();
        const auto place = frame->find(path);
        return place && frame->agents[place->agent].state(place->simplex) == state;
    }
    bool everythingRuns() {
        if (!everythingComes()) return false;
        EXPECT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
        return comes(
            [this] { return isIn("/drive", State::Active) && isIn("/controller", State::Active); });
    }
    bool everythingStops() {
        return comes([this] {
            return isIn("/drive", State::Standby) && isIn("/controller", State::Standby);
        });
    }
    // Again, where a busy machine made more than three seconds of it.
    void presses12Twice(QWidget& widget) {
        QElapsedTimer between;
        do {
            window.stopButton().setScope(std::nullopt);  // as before the first press
            QTest::keyClick(&widget, Qt::Key_F12);
            between.start();
            EXPECT_EQ(window.stopButton().text(), "Again: stop all");
            EXPECT_TRUE(window.stopButton().progress().isEmpty()) << "the first press does nothing";
            QTest::keyClick(&widget, Qt::Key_F12);
        } while (between.elapsed() >= 2900);
    }
    void pressesTwice() {
        window.stopButton().click();
        EXPECT_EQ(window.stopButton().text(), "Again: stop all");
        window.stopButton().click();
    }
    // Of /drive, which the mixer owns, in the other agent.
    bool isInRival(State state) {
        const auto frame = session.frame();
        const auto place = frame->find("/drive");
        if (!place || frame->agents[place->agent].status.name != "mixer") return false;
        return std::ranges::any_of(frame->agents, [&](const AgentFrame& each) {
            return each.status.name == "rival" && each.structure &&
                   each.state(each.structure->find("/drive")) == state;
        });
    }
    bool says(const QString& text) {
        return comes([&] { return window.stopButton().progress().contains(text); });
    }
};

TEST_F(Stopping, WhatIsNotControlledIsStoppedByASecondClickThatNamesIt) {
    ASSERT_TRUE(everythingRuns());
    QTest::mouseClick(&window.stopButton(), Qt::LeftButton);
    EXPECT_EQ(window.stopButton().text(), "Again: stop all");
    EXPECT_EQ(window.stopButton().accessibleName(), "Again: stop all, F12");
    EXPECT_TRUE(window.stopButton().progress().isEmpty()) << "the first press does nothing";
    QTest::mouseClick(&window.stopButton(), Qt::LeftButton);
    EXPECT_TRUE(window.stopButton().progress().startsWith("Stopping all: 0 of 2"));
    EXPECT_TRUE(everythingStops());
    EXPECT_TRUE(says("All 2 in Standby, ")) << window.stopButton().progress().toStdString();
    const auto labels = window.findChildren<TextLabel*>();
    EXPECT_TRUE(std::ranges::any_of(
        labels, [&](const auto* each) { return each->text() == window.stopButton().progress(); }));
}

TEST_F(Stopping, F12StopsAtItsSecondPressFromATextField) {
    ASSERT_TRUE(everythingRuns());
    window.tree().focusFilter();
    auto* field = window.findChild<QLineEdit*>();
    presses12Twice(*field);
    EXPECT_TRUE(everythingStops());
    EXPECT_TRUE(field->text().isEmpty());
}

TEST_F(Stopping, F12WorksWhileAMenuIsOpen) {
    ASSERT_TRUE(everythingRuns());
    QMenu menu;
    menu.addAction("anything");
    menu.popup({});
    presses12Twice(menu);
    EXPECT_TRUE(everythingStops());
    menu.close();
}

TEST_F(Stopping, F12WorksWhileAQuestionIsOpen) {
    ASSERT_TRUE(everythingRuns());
    Question question{{"zero on /drive?", {}, "Run zero", "Cancel"}, &window};
    question.setAttribute(Qt::WA_DeleteOnClose, false);
    question.openBelow(window.stopButton());
    presses12Twice(question.no());
    EXPECT_TRUE(everythingStops());
    question.close();
}

TEST_F(Stopping, AKeyThatIsHeldDownIsOnePress) {
    ASSERT_TRUE(everythingComes());
    QTest::keyClick(&window, Qt::Key_F12);
    QKeyEvent repeat{QEvent::KeyPress, Qt::Key_F12, Qt::NoModifier, {}, true};
    QApplication::sendEvent(&window, &repeat);
    EXPECT_TRUE(window.stopButton().progress().isEmpty());
}

TEST_F(Stopping, AFirstPressIsForgottenAfterAWhile) {
    ASSERT_TRUE(everythingComes());
    window.stopButton().click();
    EXPECT_TRUE(comes([this] { return window.stopButton().text() == "Stop all"; }));
    window.stopButton().click();
    EXPECT_EQ(window.stopButton().text(), "Again: stop all");
    EXPECT_TRUE(window.stopButton().progress().isEmpty());
}

TEST_F(Stopping, IsSentAgainUntilAnAgentThatWasNotHeardHasIt) {
    ASSERT_TRUE(everythingRuns());
    agent->send(SIGSTOP);
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    pressesTwice();
    EXPECT_TRUE(says("Stopping all: 0 of 2 in Standby; not heard: mixer"))
        << window.stopButton().progress().toStdString();
    agent->send(SIGCONT);
    EXPECT_TRUE(everythingStops());
    EXPECT_TRUE(says("All 2 in Standby, ")) << window.stopButton().progress().toStdString();
}

TEST_F(Stopping, NamesWhoWasNotReached) {
    ASSERT_TRUE(everythingRuns());
    agent->end(SIGKILL);
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    pressesTwice();
    EXPECT_TRUE(says("Not reached: mixer")) << window.stopButton().progress().toStdString();
    EXPECT_EQ(unreadableInEverySize(window, [this] { window.refresh(); }), "");
}

TEST_F(Stopping, ItsResultNamesWhenAndGoesWhenStatesNoLongerAgree) {
    ASSERT_TRUE(everythingRuns());
    pressesTwice();
    ASSERT_TRUE(says("All 2 in Standby, "));
    EXPECT_TRUE(QRegularExpression{R"( s, \d\d:\d\d:\d\d UTC$)"}
                    .match(window.stopButton().progress())
                    .hasMatch())
        << window.stopButton().progress().toStdString();
    ASSERT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
    EXPECT_TRUE(comes([this] { return window.stopButton().progress().isEmpty(); }));
}

TEST_F(Stopping, ItsResultGoesAlsoWhenTheOtherAgentWithTheSamePathRunsAgain) {
    ASSERT_TRUE(everythingComes());
    const Rival rival{ownNetwork()};
    ASSERT_TRUE(comes([this] { return isInRival(State::Standby); }));
    pressesTwice();
    ASSERT_TRUE(says("All 3 in Standby, ")) << window.stopButton().progress().toStdString();
    ASSERT_EQ(live({"call", "/rival", "startup"}).exit, 0);
    ASSERT_TRUE(comes([this] { return isInRival(State::Active); }));
    EXPECT_TRUE(comes([this] { return window.stopButton().progress().isEmpty(); }));
}

TEST_F(Stopping, WhatDidNotFollowIsNamedWithItsAgentWhereSeveralHaveThePath) {
    ASSERT_TRUE(everythingRuns());
    const Rival rival{ownNetwork(), true};
    ASSERT_TRUE(comes([this] { return isInRival(State::Fault); }));
    pressesTwice();
    EXPECT_TRUE(says("2 of 3 in Standby, ")) << window.stopButton().progress().toStdString();
    EXPECT_TRUE(says("; 1 did not follow: /drive of rival (Fault)"))
        << window.stopButton().progress().toStdString();
    ASSERT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
    ASSERT_TRUE(comes([this] { return isIn("/controller", State::Active); }));
    EXPECT_TRUE(says("; 1 did not follow: /drive of rival (Fault)")) << "until it is closed";
}

TEST(StoppingWithRights, StopsAllThatItMayStopAndSaysSo) {
    const comms::SecuredPlant plant;
    const ModelFolder folder;
    const std::string file = folder.write("mixer.xml", mixerSystem()).string();
    const Background agent{agentCommand(file) + std::vector<std::string>{"--startup", "--security",
                                                                         plant.make("mixer")}};
    comms::NetworkOptions options = ownNetwork();
    options.security = plant.make("desk", {"/controller"});
    Session session{options};
    MainWindow window{session};
    window.show();
    const auto isIn = [&](const char* path, State state) {
        const auto frame = session.frame();
        const auto place = frame->find(path);
        return place && frame->agents[place->agent].state(place->simplex) == state;
    };
    ASSERT_TRUE(
        comes([&] { return isIn("/controller", State::Active) && isIn("/drive", State::Active); }));
    StopButton& stop = window.stopButton();
    EXPECT_TRUE(comes([&] { return stop.text() == "Stop /controller"; }));
    EXPECT_EQ(stop.accessibleName(), "Stop /controller, all that you may stop, F12");
    stop.click();
    EXPECT_EQ(stop.text(), "Again: stop /controller");
    stop.click();
    EXPECT_TRUE(comes([&] { return isIn("/controller", State::Standby); }));
    EXPECT_TRUE(comes([&] {
        return stop.progress().startsWith("All 1 of /controller in Standby");
    })) << stop.progress().toStdString();
    EXPECT_TRUE(stop.progress().contains("; you may command nothing else, "))
        << stop.progress().toStdString();
    EXPECT_TRUE(isIn("/drive", State::Active));
    stop.stop("/");
    EXPECT_TRUE(comes([&] {
        return stop.progress().startsWith("All 1 of /controller in Standby");
    })) << stop.progress().toStdString();
}

TEST(StoppingAlone, SaysThatNobodyIsHeard) {
    Session session{ownNetwork()};
    MainWindow window{session};
    window.stopButton().click();
    window.stopButton().click();
    EXPECT_EQ(window.stopButton().progress(), "Nobody is heard: nothing was stopped.");
}

// What is painted of the button, at the smallest window's text and at the usual one.
class StopInLongWords : public testing::Test {
protected:
    ~StopInLongWords() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    void inEverySize(const std::function<void(const std::string& where)>& look) {
        for (const char* family : {"DejaVu Sans", "Open Sans"}) {
            for (const double scale : {1.0, 1.5}) {
                Look::apply(Theme::Light, scale, QLatin1String{family});
                stop.resize(stop.sizeHint());
                look(family + std::to_string(scale));
            }
        }
    }
    // All lines, of which none is outside.
    QString painted() {
        QString seen;
        for (const PaintedText& each : paintedTexts(stop)) {
            const int spare = each.box.height() / 4;  // above and below letters
            EXPECT_TRUE(stop.rect().adjusted(0, -spare, 0, spare).contains(each.box));
            seen += each.text;
        }
        return seen.remove(' ');
    }

    Session session{ownNetwork()};
    StopButton stop{session};
};

TEST_F(StopInLongWords, AScopeOfFortyLettersIsWholeAlsoAtItsSecondPress) {
    for (const std::string scope :
         {"/levelling/platform/hydraulics/left_cell", "/very/long/prefix/of/some/cell/of/plants",
          "/manipulator/left_arm/gripper/controller"}) {
        ASSERT_EQ(scope.size(), 40U);
        inEverySize([&](const std::string& where) {
            stop.setScope(scope);
            EXPECT_EQ(painted().toStdString(), "Stopalways" + scope) << where;
            stop.click();
            EXPECT_EQ(painted().toStdString(), "Again:stop" + scope) << where;
            EXPECT_EQ(stop.size(), stop.sizeHint()) << where;
        });
    }
}

TEST_F(StopInLongWords, OfALongerScopeItSaysTheEndWherePathsDiffer) {
    const std::string scope = "/levelling/platform/hydraulics/left_cell/valves/proportional/second";
    inEverySize([&](const std::string& where) {
        stop.setScope(scope);
        const QString seen = painted();
        EXPECT_TRUE(seen.startsWith("Stopalways…")) << where << seen.toStdString();
        EXPECT_TRUE(seen.endsWith("/valves/proportional/second")) << where << seen.toStdString();
    });
}

}  // namespace
}  // namespace cortex::test
