// SPDX-License-Identifier: Apache-2.0
// What Stop stopped is started again, with two real agents over DDS.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/clock.hpp"

#include "gui/audit.hpp"
#include "gui/window_fixture.hpp"
#include "support/probe.hpp"
#include "widgets/question.hpp"
#include "window/control_bar.hpp"
#include "window/control_notice.hpp"
#include "window/order.hpp"
#include "window/stop_button.hpp"

#include <QApplication>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QTreeView>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// An agent of this process on the network of the test.
struct Plant {
    explicit Plant(const std::string& name) : probes{{}, name} {
        probes.trigger = nullptr;
        probes.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{5});
        probes.cluster->addInterface<comms::DdsInterface>(ownNetwork());
    }
    ~Plant() { probes.cluster->stop(); }  // before its hooks go
    Plant(const Plant&) = delete;
    Plant& operator=(const Plant&) = delete;

    Probe& probe(const char* path) { return probes.probe(path); }
    void startup(const char* path) { probes.cluster->send(path, "startup"); }

    ProbeCluster probes;
};

// Agent "left" has /cell/base and /cell/idle; agent "right" has /cell/arm, which reads /cell/base,
// and /cell/tool, which reads /cell/arm.
class StartingAgain : public testing::Test {
protected:
    StartingAgain() {
        right.probes.tree.relateRemote(arm, "before", "/cell/base", "Probe");
        right.probes.tree.relate(tool, "before", arm);
        for (Probe* each : {&base, &arm, &tool}) note(*each);
        window.show();
    }
    void note(Probe& probe) {
        probe.onStartingUp = [this, &probe](Probe&, const Tick&) {
            if (hangs == &probe) return false;
            if (fails == &probe) probe.fault(7, "there is no air");
            const std::lock_guard lock{mutex};
            started.push_back(probe.path());
            return true;
        };
    }
    bool runs(const std::vector<std::string>& paths) {
        left.probes.start();
        right.probes.start();
        for (const std::string& each : paths)
            (each == "/cell/base" || each == "/cell/idle" ? left : right).startup(each.c_str());
        const bool all = comes([&] {
            const bool known = std::ranges::all_of(
                std::array{"/cell/base", "/cell/idle", "/cell/arm", "/cell/tool"},
                [&](const char* each) { return session.frame()->find(each).has_value(); });
            return known && areIn(State::Active, paths);
        });
        const std::lock_guard lock{mutex};
        started.clear();
        return all;
    }
    bool areIn(State state, const std::vector<std::string>& paths) {
        const auto frame = session.frame();
        return std::ranges::all_of(paths, [&](const std::string& each) {
            const auto place = frame->find(each);
            return place && frame->agents[place->agent].state(place->simplex) == state;
        });
    }
    bool takes(const std::string& prefix) {
        window.control().choose(prefix);
        window.control().panel()->takeButton().click();
        return comes([&] { return window.control().prefix() == prefix; });
    }
    // At one press where all is controlled, otherwise at the second.
    bool stops() {
        window.stopButton().click();
        if (window.stopButton().text().startsWith("Again")) window.stopButton().click();
        return comes([this] { return window.stopButton().progress().contains(" in Standby, "); });
    }
    // Everything, while there is but one of the agents.
    bool holdsLeftOnly() {
        left.probes.start();
        const bool isThere =
            comes([this] { return session.frame()->find("/cell/base").has_value(); });
        if (!isThere || !takes("/")) return false;
        right.probes.start();
        return comes([this] {
            const auto frame = session.frame();
            return frame->find("/cell/arm") && !frame->control.covers("right", "/") &&
                   areIn(State::Standby, three);
        });
    }
    // As it should.
    bool rightEnds() {
        right.probes.cluster->stop();
        return comes([this] {
            const auto frame = session.frame();
            return std::ranges::any_of(frame->agents, [](const AgentFrame& each) {
                return each.status.name == "right" && each.status.ended;
            });
        });
    }
    bool stopSays(const QString& start, const QString& part) {
        const QString& text = window.stopButton().progress();
        return text.startsWith(start) && text.contains(part);
    }
    bool offers(const QString& text) {
        return comes([&] {
            QPushButton& again = window.control().notice().againButton();
            return (again.isVisible() ? again.text() : QString{}) == text;
        });
    }
    void pressAgain() { window.control().notice().againButton().click(); }
    bool says(const QString& text) {
        return comes([&] { return window.startAgain().text().contains(text); });
    }
    std::vector<std::string> inTheirOrder() {
        const std::lock_guard lock{mutex};
        return started;
    }
    QAction* entry(const QString& text) {
        for (auto* each : window.findChildren<QMenu*>()) {
            Q_EMIT each->aboutToShow();
            for (QAction* action : each->actions())
                if (action->text().startsWith(text)) return action;
        }
        return nullptr;
    }
    QAction* inTreeMenu(const std::string& path, const QString& text) {
        auto* rows = window.tree().findChild<QTreeView*>();
        const QRect at = rows->visualRect(window.tree().model().indexOf(path));
        Q_EMIT rows->customContextMenuRequested(at.center());
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        if (menu == nullptr) return nullptr;
        for (QAction* each : menu->actions())
            if (each->text() == text) return each;
        return nullptr;
    }

    const std::vector<std::string> three{"/cell/base", "/cell/arm", "/cell/tool"};
    const std::vector<std::string> others{"/cell/idle", "/cell/arm", "/cell/tool"};
    std::mutex mutex;
    std::vector<std::string> started;
    std::atomic<Probe*> hangs{nullptr}, fails{nullptr};
    Plant left{"left"}, right{"right"};
    Probe &base = left.probe("/cell/base"), &idle = left.probe("/cell/idle");
    Probe &arm = right.probe("/cell/arm"), &tool = right.probe("/cell/tool");
    Session session{ownNetwork()};
    MainWindow window{session};
};

TEST_F(StartingAgain, OnePressStartsExactlyWhatWasActiveInItsOrderAcrossAgents) {
    ASSERT_TRUE(runs(three));
    ASSERT_TRUE(takes("/cell"));
    ASSERT_TRUE(stops()) << window.stopButton().progress().toStdString();
    ASSERT_TRUE(offers("Start these 3 again"));
    const QRect place = window.control().notice().geometry();
    EXPECT_TRUE(window.stopButton().progress().startsWith("All 4 of /cell in Standby, "));
    pressAgain();
    EXPECT_TRUE(says("All 3 Active again, ")) << window.startAgain().text().toStdString();
    EXPECT_EQ(inTheirOrder(), three);
    EXPECT_TRUE(areIn(State::Standby, {"/cell/idle"}));
    EXPECT_TRUE(offers({})) << "nothing of it is left";
    EXPECT_EQ(window.control().notice().geometry(), place);
}

TEST_F(StartingAgain, WhoeverRefusesIsNamedAndThoseThatRelyOnItAreCounted) {
    ASSERT_TRUE(runs(three));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 3 again"));
    fails = &base;
    pressAgain();
    EXPECT_TRUE(says("0 of 3 Active again, ")) << window.startAgain().text().toStdString();
    EXPECT_TRUE(
        says("; /cell/base did not start: it is in Fault: there is no air; 2 wait for it, "))
        << window.startAgain().text().toStdString();
    EXPECT_TRUE(areIn(State::Standby, {"/cell/arm", "/cell/tool"}));
    EXPECT_TRUE(offers("Start these 2 again"));
    EXPECT_EQ(unreadableInEverySize(window, [this] { window.refresh(); }), "");
    fails = nullptr;
    session.send("/cell/base", "clearFaults");
    ASSERT_TRUE(offers("Start these 3 again")) << "it can be started by now";
    session.send("/cell/base", "startup");
    ASSERT_TRUE(offers("Start these 2 again"));
    pressAgain();
    EXPECT_TRUE(says("All 2 Active again, ")) << window.startAgain().text().toStdString();
}

TEST_F(StartingAgain, AsksForControlFirstAndStartsNothingWithoutIt) {
    ASSERT_TRUE(runs({"/cell/base", "/cell/arm"}));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 2 again"));
    pressAgain();
    EXPECT_EQ(window.startAgain().text(), "Starting 2 again: needs control");
    ASSERT_NE(window.control().panel(), nullptr);
    EXPECT_EQ(window.control().panel()->takeButton().text(), "Take /cell");
    window.control().panel()->close();
    ASSERT_TRUE(takes("/cell"));
    ASSERT_TRUE(offers("Start these 2 again")) << "control was declined";
    EXPECT_TRUE(areIn(State::Standby, three));
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    pressAgain();
    window.control().panel()->takeButton().click();
    EXPECT_TRUE(says("All 2 Active again, ")) << window.startAgain().text().toStdString();
}

TEST_F(StartingAgain, ASecondStopLosesNothingOfTheFirst) {
    ASSERT_TRUE(runs({"/cell/base", "/cell/arm"}));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 2 again"));
    session.send("/cell/tool", "startup");
    ASSERT_TRUE(comes([this] { return areIn(State::Active, {"/cell/tool"}); }));
    ASSERT_TRUE(offers("Start these 2 again")) << "that was not stopped";
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 3 again"));
    ASSERT_TRUE(stops());
    EXPECT_TRUE(offers("Start these 3 again"));
    ASSERT_TRUE(rightEnds());
    ASSERT_TRUE(offers("Start these 3 again")) << "it may come back";
    pressAgain();
    EXPECT_TRUE(says("1 of 3 Active again, ")) << window.startAgain().text().toStdString();
    EXPECT_TRUE(says("; ended: right, ")) << window.startAgain().text().toStdString();
}

TEST_F(StartingAgain, AStopEndsItAndWhatWaitsIsNotStartedLater) {
    ASSERT_TRUE(runs(three));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 3 again"));
    hangs = &base;
    pressAgain();
    ASSERT_TRUE(comes([this] { return areIn(State::StartingUp, {"/cell/base"}); }));
    EXPECT_EQ(window.startAgain().text(), "Starting 3 again: 0 Active");
    EXPECT_TRUE(offers({}));
    ASSERT_TRUE(stops());
    hangs = nullptr;
    EXPECT_TRUE(window.startAgain().text().isEmpty());
    EXPECT_TRUE(offers("Start these 3 again"));
    session.send("/cell/base", "startup");
    ASSERT_TRUE(offers("Start these 2 again"));
    EXPECT_TRUE(areIn(State::Standby, {"/cell/arm", "/cell/tool"}));
}

TEST_F(StartingAgain, TheMenuHasItAlsoOnceTheNoticeWasClosed) {
    ASSERT_TRUE(runs({"/cell/base"}));
    const QString words = "Start again";
    ASSERT_NE(entry(words), nullptr);
    EXPECT_EQ(entry(words)->text(), words + ": nothing was stopped");
    EXPECT_FALSE(entry(words)->isEnabled());
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start it again"));
    for (auto* each : window.control().notice().findChildren<QPushButton*>())
        if (each->text() == "Close") each->click();
    EXPECT_TRUE(offers({}));
    EXPECT_EQ(entry(words)->text(), words + " what Stop stopped");
    entry(words)->trigger();
    EXPECT_TRUE(says("All 1 Active again, ")) << window.startAgain().text().toStdString();
    EXPECT_EQ(entry(words)->text(), words + ": nothing was stopped");
}

TEST_F(StartingAgain, WhatAManagerLooksAfterIsLeftToIt) {
    left.probes.tree.relate(base, "after", idle);
    base.onPopulate = [](Probe& self) { self.lifeCycle(self.output("after"), true); };
    ASSERT_TRUE(runs({"/cell/base", "/cell/idle"}));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(stops());
    ASSERT_TRUE(offers("Start these 2 again"));
    pressAgain();
    EXPECT_TRUE(says("1 of 2 Active again, ")) << window.startAgain().text().toStdString();
    EXPECT_TRUE(says("; /cell/idle did not start: it is left to what manages it, "))
        << window.startAgain().text().toStdString();
    EXPECT_TRUE(areIn(State::Standby, {"/cell/idle"}));
}

TEST_F(StartingAgain, AnAgentsOwnRowStopsAndStartsThatAgentAlone) {
    ASSERT_TRUE(runs(three));
    ASSERT_TRUE(comes([this] { return window.tree().model().indexOf("/left").isValid(); }));
    QAction* stop = inTreeMenu("/left", "Stop all of agent left");
    ASSERT_NE(stop, nullptr);
    stop->trigger();
    EXPECT_TRUE(comes([this] {
        return window.stopButton().progress().startsWith("All 2 of agent left in Standby");
    })) << window.stopButton().progress().toStdString();
    EXPECT_TRUE(areIn(State::Active, {"/cell/arm", "/cell/tool"}));
    ASSERT_TRUE(offers("Start it again"));
    QAction* start = inTreeMenu("/left", "Start all of agent left");
    ASSERT_NE(start, nullptr);
    start->trigger();
    EXPECT_EQ(window.startAll().text(), "Starting all of agent left: needs control");
    EXPECT_EQ(window.control().panel()->takeButton().text(), "Take everything");
    window.control().panel()->takeButton().click();
    EXPECT_TRUE(comes([this] { return areIn(State::Active, {"/cell/base", "/cell/idle"}); }));
}

TEST_F(StartingAgain, OnePressStopsNothingOfAnAgentThatIsNotControlled) {
    ASSERT_TRUE(holdsLeftOnly());
    session.send("/cell/base", "startup");
    right.startup("/cell/arm");
    ASSERT_TRUE(comes([this] { return areIn(State::Active, {"/cell/base", "/cell/arm"}); }));
    ASSERT_TRUE(comes([this] { return window.stopButton().text() == "Stop all but right"; }))
        << window.stopButton().text().toStdString();
    ASSERT_TRUE(stops());
    EXPECT_TRUE(stopSays("All 2 that you control in Standby, ", "not controlled: right, "))
        << window.stopButton().progress().toStdString();
    EXPECT_TRUE(areIn(State::Active, {"/cell/arm"}));
    window.stopButton().setScope("/");
    window.stopButton().click();
    EXPECT_EQ(window.stopButton().text(), "Again: stop all");
    window.stopButton().click();
    EXPECT_TRUE(comes([this] { return areIn(State::Standby, {"/cell/arm"}); }));
}

TEST_F(StartingAgain, StartAllAsksForControlOfAnAgentThatIsNotControlled) {
    ASSERT_TRUE(holdsLeftOnly());
    entry("Start all…")->trigger();
    EXPECT_EQ(window.startAll().text(), "Starting all: needs control");
    ASSERT_NE(window.control().panel(), nullptr);
    window.control().panel()->close();
    EXPECT_TRUE(window.startAll().text().isEmpty());
    session.send("/cell/idle", "startup");  // what was sent before it was done before it
    ASSERT_TRUE(comes([this] { return areIn(State::Active, {"/cell/idle"}); }));
    EXPECT_TRUE(inTheirOrder().empty()) << "also of the agent that is controlled";
    entry("Start all…")->trigger();
    window.control().panel()->takeButton().click();
    EXPECT_TRUE(comes([this] { return areIn(State::Active, three); }));
}

TEST_F(StartingAgain, TheMenuAsksBeforeItStartsWhatIsControlled) {
    ASSERT_TRUE(runs({"/cell/base"}));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(comes([this] { return areIn(State::Standby, others); }));
    const auto asked = [this]() -> Question* {
        entry("Start all…")->trigger();
        for (auto* each : window.findChildren<Question*>())
            if (each->isVisible()) return each;
        return nullptr;
    };
    Question* question = asked();
    ASSERT_NE(question, nullptr);
    const auto labels = question->findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(
        labels, [](auto* each) { return each->text() == "3 simplexes are in Standby."; }));
    EXPECT_EQ(question->accessibleName(), "Start everything?");
    QTest::keyClick(question, Qt::Key_Return);
    EXPECT_FALSE(question->isVisible());
    EXPECT_TRUE(window.startAll().text().isEmpty()) << "what changes nothing has the keyboard";
    question = asked();
    ASSERT_NE(question, nullptr);
    question->yes().click();
    EXPECT_TRUE(comes([this] { return areIn(State::Active, three); }));
}

TEST_F(StartingAgain, NothingIsMissedOfAnAgentThatEndedAsItShould) {
    ASSERT_TRUE(runs(three));
    ASSERT_TRUE(takes("/"));
    ASSERT_TRUE(rightEnds());
    window.stopButton().click();
    EXPECT_TRUE(stopSays("Stopping all: ", " of 2 in Standby; ended: right")) << "it is not told";
    EXPECT_TRUE(comes([this] { return stopSays("All 2 in Standby, ", "; ended: right, "); }))
        << window.stopButton().progress().toStdString();
    const QString lost = "Control of / of agent right was lost: the agent has ended.";
    EXPECT_TRUE(comes([&] { return window.control().notice().text().contains(lost); }))
        << window.control().notice().text().toStdString();
}

TEST_F(StartingAgain, TheMenuStartsAllOfEverythingOnceControlIsGiven) {
    ASSERT_TRUE(runs({"/cell/base"}));
    entry("Start all…")->trigger();
    EXPECT_EQ(window.startAll().text(), "Starting all: needs control");
    ASSERT_NE(window.control().panel(), nullptr);
    window.control().panel()->takeButton().click();
    EXPECT_TRUE(comes([this] { return areIn(State::Active, others); }));
}

}  // namespace
}  // namespace cortex::test
