// SPDX-License-Identifier: Apache-2.0
// Control that somebody else has, gives or gets, with a real agent over DDS.
#include "gui/controlling.hpp"
#include "gui/made_agent.hpp"
#include "gui/places.hpp"
#include "model/holders.hpp"
#include "window/stop_button.hpp"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>

namespace cortex::test {
namespace {

TEST_F(Controlling, SaysWhoHoldsItAndTakesItWhenTheyAreGone) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    {
        Session other{ownNetwork()};
        ASSERT_TRUE(comes([&] {
            const auto frame = other.frame();
            return frame->find("/drive").has_value();
        }));
        other.isAlive();
        other.takeControl("/drive");
        const auto isHeld = [&] {
            other.isAlive();
            return !other.frame()->control.prefix.empty();
        };
        ASSERT_TRUE(comes(isHeld));
        const QString holder = QString::fromStdString(other.frame()->control.self);
        EXPECT_TRUE(comes([&] { return isHeld() && says("held by " + holder + " since "); }));
        window.control().choose();
        window.control().panel()->choose("/");
        window.control().panel()->takeButton().click();
        EXPECT_TRUE(comes([&] { return isHeld() && !window.control().notice().text().isEmpty(); }));
        const auto whole = [&] {
            return wholeNameOf(session.frame()->control, holder.toStdString());
        };
        EXPECT_TRUE(comes([&] {
            return isHeld() && window.control().notice().text() ==
                                   "Control of / was not taken. mixer: " + whole() +
                                       " holds /drive, and must release it or hand it over.";
        })) << window.control().notice().text().toStdString();
        EXPECT_FALSE(window.control().holds());
    }
    EXPECT_TRUE(comes([this] { return says("read-only"); })) << "its end releases";
    EXPECT_TRUE(takes("/"));
    EXPECT_TRUE(window.control().notice().text().isEmpty());
}

// What was refused for the sake of others, and is theirs no more, is said so, and is offered.
TEST_F(Controlling, ARefusalFollowsTheLeasesOfOthers) {
    ASSERT_TRUE(everythingComes());
    Colleague first, second;
    ASSERT_TRUE(comes([&] { return first.sees("/drive") && second.sees("/drive"); }));
    window.open("/controller");
    ASSERT_TRUE(takes("/controller"));
    session.releaseControl();  // what was held before is not what is refused
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    first.control();
    first.session.takeControl("/drive");
    ASSERT_TRUE(comes([&] { return !first.control().prefix.empty(); }));
    window.control().choose();
    window.control().panel()->choose("/");
    window.control().panel()->takeButton().click();
    const ControlNotice& notice = window.control().notice();
    const auto isSaid = [&](const std::string& text) {
        return comes([&] {
            first.control();
            second.control();
            return notice.text().contains(QString::fromStdString(text));
        });
    };
    EXPECT_TRUE(isSaid(first.control().self + ") holds /drive"));
    EXPECT_TRUE(window.control().notice().remedy().text().startsWith("Ask "));
    first.session.handOver(second.control().self);
    EXPECT_TRUE(isSaid(second.control().self + ") holds /drive")) << notice.text().toStdString();
    ASSERT_TRUE(comes([&] { return !second.control().prefix.empty(); }));
    second.session.releaseControl();
    EXPECT_TRUE(isSaid("Nobody else holds a part of it any longer."));
    EXPECT_EQ(window.control().notice().remedy().text(), "Take everything");
    window.control().notice().remedy().click();
    EXPECT_TRUE(comes([this] { return window.control().prefix() == "/"; }));
    EXPECT_TRUE(comes([&] { return notice.text().isEmpty(); }));
}

TEST_F(Controlling, HandsControlOverAndTakesItAgain) {
    ASSERT_TRUE(everythingComes());
    Colleague other;
    ASSERT_TRUE(comes([&] { return other.sees("/drive"); }));
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    window.control().chooseHandOver();
    auto* panel = window.control().handOverPanel();
    ASSERT_NE(panel, nullptr);
    EXPECT_FALSE(panel->handOverButton().isEnabled()) << "nobody is named";
    const QString name = QString::fromStdString(other.control().self);
    panel->nameField().setText(name);
    panel->handOverButton().click();
    ASSERT_TRUE(comes([&] { return other.control().prefix == "/drive"; }));
    ASSERT_TRUE(comes([&] { return !window.control().holds(); }));
    EXPECT_EQ(window.control().notice().text(),
              "Control of /drive was handed over to " +
                  wholeNameOf(session.frame()->control, name.toStdString()) + ".");
    EXPECT_TRUE(comes([&] { return other.control().held.size() == 1 && says("held by " + name); }));
    other.session.releaseControl();
    ASSERT_TRUE(comes([&] { return other.control().prefix.empty() && says("read-only"); }));
    EXPECT_EQ(window.control().notice().remedy().text(), "Take /drive again");
    window.control().notice().remedy().click();
    EXPECT_TRUE(comes([&] { return window.control().prefix() == "/drive"; }));
}

TEST_F(Controlling, KeepsWhatIsHandedOverToIt) {
    ASSERT_TRUE(everythingComes());
    Colleague other;
    ASSERT_TRUE(comes([&] { return other.sees("/drive"); }));
    other.control();
    other.session.takeControl("/drive");
    ASSERT_TRUE(comes([&] { return other.control().prefix == "/drive"; }));
    other.session.handOver(session.frame()->control.self);
    ASSERT_TRUE(comes([&] { return window.control().prefix() == "/drive"; }));
    EXPECT_EQ(window.control().notice().text(), "Control of /drive of agent mixer is yours now.");
    // An agent ends a lease 2 s after its last renewal: 300 cycles of 10 ms are longer.
    const auto cycle = [this] { return session.frame()->agents.front().status.cycle; };
    const std::int64_t then = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > then + 300; }));
    EXPECT_EQ(window.control().prefix(), "/drive");
    EXPECT_NE(leases().find("/drive"), std::string::npos);
}

TEST_F(Controlling, ANameThatNobodyHasEndsControlAndIsTold) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    session.handOver("nobody@nowhere.1-000000");
    EXPECT_TRUE(comes([&] { return !window.control().notice().text().isEmpty(); }));
    EXPECT_TRUE(comes([] { return leases().find("nobody@") == std::string::npos; }));
    const QString text =
        "Control of /drive was handed over to nobody@nowhere.1-000000. Nobody "
        "holds it now: /drive is free.";
    EXPECT_TRUE(comes([&] { return window.control().notice().text() == text; }))
        << window.control().notice().text().toStdString();
    EXPECT_EQ(window.control().notice().remedy().text(), "Take /drive again");
    window.control().notice().remedy().click();
    EXPECT_TRUE(comes([this] { return window.control().prefix() == "/drive"; }));
    EXPECT_TRUE(comes([this] { return window.control().notice().text().isEmpty(); }));
}

TEST_F(Controlling, WhereNobodyHoldsAnythingHandingOverSaysWhatToDo) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    auto* menu = window.findChild<QMenu*>();
    ASSERT_NE(menu, nullptr);
    const auto entry = [menu] {
        Q_EMIT menu->aboutToShow();
        for (const QAction* each : menu->actions()) {
            if (each->text().startsWith("Hand over control")) return each;
        }
        throw std::runtime_error{"no such entry"};
    };
    EXPECT_FALSE(entry()->isEnabled());
    EXPECT_EQ(entry()->text(), "Hand over control: you hold nothing");
    ASSERT_TRUE(takes("/drive"));
    EXPECT_TRUE(entry()->isEnabled());
    window.control().chooseHandOver();
    auto* panel = window.control().handOverPanel();
    ASSERT_NE(panel, nullptr);
    EXPECT_TRUE(panel->whyNobody().startsWith("No other window or shell is there"));
    Colleague other;
    EXPECT_TRUE(comes([&] { return !panel->offered().empty(); })) << "also without any lease";
    EXPECT_EQ(panel->whyNobody(), "");
}

TEST_F(Controlling, TakesAgainWhatASilenceTookAlsoOnceTheNoticeIsClosed) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    QPushButton& again = window.control().againButton();
    EXPECT_TRUE(again.isHidden());
    agent->send(SIGSTOP);
    ASSERT_TRUE(comes(
        [this] { return !window.control().holds() && session.frame()->agents.front().lost(); }));
    window.refresh();
    EXPECT_TRUE(again.isHidden()) << "nobody would hear it";
    agent->send(SIGCONT);
    ASSERT_TRUE(comes([&] { return !again.isHidden(); }));
    Q_EMIT window.control().notice().closed();
    EXPECT_EQ(window.control().notice().text(), "");
    window.refresh();
    EXPECT_FALSE(again.isHidden());
    again.click();
    EXPECT_TRUE(comes([this] { return window.control().prefix() == "/drive"; }));
    EXPECT_TRUE(comes([&] { return again.isHidden(); }));
    window.control().release();
    EXPECT_TRUE(comes([this] { return !window.control().holds(); }));
    EXPECT_TRUE(again.isHidden()) << "what is released is not missing";
}

// Made by hand: what the bar says of two agents, of which one falls silent or ends.
class TwoAgentsInTheBar : public testing::Test {
protected:
    TwoAgentsInTheBar() {
        auto* row = new QHBoxLayout{&host};
        row->addStretch(1);
        row->addWidget(&bar);
        host.resize(1400, 50);
        host.show();
    }
    void show(const std::vector<comms::LeaseClient::Lease>& held, const std::string& ofRight) {
        std::vector<AgentFrame> agents{left.now(),
                                       right.now(ofRight == "running" ? "running" : "lost")};
        agents.back().status.ended = ofRight == "ended";
        const auto frame = frameOf(std::move(agents));
        frame->control.held = held;
        frame->control.prefix = held.empty() ? "" : held.front().prefix;
        frame->control.claims = {"/"};
        bar.refresh(frame, "");
        for (int i = 0; i < 3; ++i) QApplication::processEvents();
    }
    QRect placeOf(const QString& text) {
        for (auto* each : bar.findChildren<QPushButton*>()) {
            if (each->text() == text && !each->isHidden())
                return {each->mapTo(&host, QPoint{}), each->size()};
        }
        return {};
    }

    const comms::LeaseClient::Lease first{"left", "/", 1}, second{"right", "/", 1};
    MadeAgent left{"left", [](SimplexTree& tree) { tree.add("/a", "Probe"); }};
    MadeAgent right{"right", [](SimplexTree& tree) { tree.add("/b", "Probe"); }};
    Session session{ownNetwork()};
    QWidget host;
    ControlBar bar{session};
};

TEST_F(TwoAgentsInTheBar, EverythingIsNeverSaidWhileOneOfThemIsNotControlled) {
    show({first, second}, "running");
    EXPECT_TRUE(bar.text().startsWith("You control everything since ")) << bar.text().toStdString();
    EXPECT_TRUE(bar.text().endsWith(" UTC"));
    EXPECT_EQ(bar.missing(), "");
    show({first}, "running");
    EXPECT_EQ(bar.text(), "You control everything but right");
    EXPECT_EQ(bar.missing(), "/");
    EXPECT_FALSE(bar.againButton().isHidden());
    show({first}, "lost");
    EXPECT_EQ(bar.text(), "You control everything but right") << "it is silent, not gone";
    EXPECT_EQ(bar.missing(), "") << "nobody would hear it";
    bar.setNarrow(true);
    EXPECT_EQ(bar.text(), "You control all but right");
    bar.setNarrow(false);
    show({first}, "ended");
    EXPECT_TRUE(bar.text().startsWith("You control everything since ")) << "it ended as it should";
}

TEST_F(TwoAgentsInTheBar, NoButtonStandsWhereAnotherOneStoodWhenControlIsLost) {
    show({first, second}, "running");
    const QRect releaseAt = placeOf("Release"), handOverAt = placeOf("Hand over…");
    ASSERT_FALSE(releaseAt.isEmpty());
    ASSERT_FALSE(handOverAt.isEmpty());
    show({first}, "running");
    EXPECT_EQ(placeOf("Release"), releaseAt);
    EXPECT_EQ(placeOf("Hand over…"), handOverAt);
    const QRect againAt = placeOf("Take again");
    ASSERT_FALSE(againAt.isEmpty());
    show({}, "running");
    EXPECT_EQ(placeOf("Take again"), againAt);
    EXPECT_EQ(placeOf("Take control…"), releaseAt);
}

TEST(StopOfWhatIsHeld, LeavesOutAnAgentThatIsNotControlledAndNamesIt) {
    MadeAgent left{"left", [](SimplexTree& tree) { tree.add("/a", "Probe"); }};
    MadeAgent right{"right", [](SimplexTree& tree) {
                        tree.add("/b", "Probe");
                        tree.add("/right", "Cluster");
                    }};
    Session session{ownNetwork()};
    StopButton stop{session};
    std::vector<comms::LeaseClient::Lease> held{{"left", "/", 1}};
    const auto said = [&](const std::string& stateOfRight, bool ended = false) {
        std::vector<AgentFrame> agents{left.now(), right.now(stateOfRight)};
        agents.back().status.ended = ended;
        const auto frame = frameOf(std::move(agents));
        frame->control.held = held;
        frame->control.prefix = "/";
        stop.refresh(*frame, {});
        return stop.text().toStdString();
    };
    EXPECT_EQ(said("running"), "Stop all but right") << "nobody holds it";
    giveLease(right, "/right", "/b", "colleague@desk.1-2");
    EXPECT_EQ(said("running"), "Stop all but right");
    EXPECT_EQ(said("lost"), "Stop all but right");
    EXPECT_EQ(said("lost", true), "Stop all") << "it ended as it should";
    held.push_back({"right", "/b", 1});
    EXPECT_EQ(said("running"), "Stop all but a part of right");
    held.back().prefix = "/";
    EXPECT_EQ(said("running"), "Stop all");
    held.pop_back();
    stop.setScope("/");
    EXPECT_EQ(said("running"), "Stop always all");
    stop.click();
    EXPECT_EQ(stop.text().toStdString(), "Again: stop all") << "it is more than is controlled";
}

TEST(TakingControl, SaysHowManyRunAndHowManyAreInFault) {
    MadeAgent robot{"robot", [](SimplexTree& tree) {
                        for (const char* each : {"/a", "/b", "/c"}) tree.add(each, "Probe");
                    }};
    robot.put("/a", "state", std::int64_t{2});
    robot.put("/b", "state", std::int64_t{4});
    robot.put("/c", "state", std::int64_t{0});
    const ControlPanel panel{frameOf({robot.now()}), ""};
    const auto labels = panel.findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [](const QLabel* each) {
        return each->text().contains(
            "1 active; when control is lost 1 go on, 0 hold, 0 shut down; "
            "1 in Fault");
    }));
}

// What others take and release while a dialog is open.
class WhileADialogIsOpen : public testing::Test {
protected:
    using Rects = std::map<std::string, QRect>;
    WhileADialogIsOpen() { anchor.setGeometry(0, 0, 100, 30); }  // there is room below it
    std::shared_ptr<Frame> now() {
        const auto frame = frameOf({left.now(), right.now()});
        frame->control.self = "own@desk.100-5e1f0a";
        return frame;
    }
    // On the screen: of all that can be pressed or typed into, and of each row by its name.
    static Rects places(Popover& panel) {
        Rects all;
        for (const auto& [widget, place] : placesIn(panel))
            all[nameOf(*widget)] = place.translated(panel.pos());
        for (auto* list : panel.findChildren<QListWidget*>()) {
            for (int i = 0; i < list->count(); ++i)
                all[list->item(i)->text().section(' ', 0, 0).toStdString()] =
                    list->visualItemRect(list->item(i))
                        .translated(list->viewport()->mapToGlobal({}));
        }
        return all;
    }
    static std::string movedSince(const Rects& before, Popover& panel) {
        std::string moved;
        for (const auto& [name, place] : places(panel)) {
            const auto was = before.find(name);
            if (was != before.end() && was->second != place) moved += name + '\n';
        }
        return moved;
    }
    MadeAgent left{"left", [](SimplexTree& tree) { tree.add("/left", "Cluster"); }};
    MadeAgent right{"right", [](SimplexTree& tree) { tree.add("/right", "Cluster"); }};
    QPushButton anchor;
};

TEST_F(WhileADialogIsOpen, NamesKeepTheirRowsAndNoButtonMovesAsNamesComeAndGo) {
    HandOverPanel panel{now()};
    panel.openBelow(anchor);
    auto* list = panel.findChild<QListWidget*>();
    const Rects withNobody = places(panel);
    EXPECT_EQ(withNobody.size(), 3U);
    giveLease(left, "/left", "/left", "maria@desk.2-2");
    panel.refresh(now());
    EXPECT_EQ(movedSince(withNobody, panel), "");
    const Rects withOne = places(panel);
    giveLease(right, "/right", "/right", "anna@desk.1-1");
    panel.refresh(now());
    EXPECT_EQ(movedSince(withOne, panel), "") << "anna is added below";
    const Rects withTwo = places(panel);
    giveLease(left, "/left", "", "");
    panel.refresh(now());
    EXPECT_EQ(movedSince(withTwo, panel), "") << "maria keeps her row";
    EXPECT_EQ(list->item(0)->text(), "maria@desk.2-2 – holds nothing now");
    EXPECT_FALSE(list->item(0)->flags().testFlag(Qt::ItemIsEnabled));
}

TEST_F(WhileADialogIsOpen, NoPartAndNoButtonMovesAsAPartIsTakenAndReleased) {
    ControlPanel panel{now(), "/left"};
    panel.openBelow(anchor);
    const Rects atFirst = places(panel);
    EXPECT_EQ(atFirst.size(), 4U) << "two parts and two buttons";
    giveLease(left, "/left", "/left", "colleague@desk.200-5e1f0b");
    panel.refresh(now());
    QString said;
    for (const auto* each : panel.findChildren<QLabel*>()) said += each->text();
    EXPECT_TRUE(said.contains("colleague@desk.200-5e1f0b holds /left since "));
    EXPECT_EQ(movedSince(atFirst, panel), "");
    giveLease(left, "/left", "", "");
    panel.refresh(now());
    EXPECT_EQ(movedSince(atFirst, panel), "");
}

}  // namespace
}  // namespace cortex::test
