// SPDX-License-Identifier: Apache-2.0
// What happened before the window was opened, and before a fault, with real agents over DDS.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/clock.hpp"

#include "dds/participant.hpp"
#include "gui/window_fixture.hpp"
#include "support/probe.hpp"
#include "views/event_table.hpp"
#include "views/event_view.hpp"
#include "views/fault_history_view.hpp"
#include "views/message_area.hpp"
#include "widgets/text_label.hpp"
#include "window/workspace.hpp"
#include "wire/ids.hpp"
#include "wire/messages.hpp"

#include <QAbstractButton>
#include <QRegularExpression>
#include <QTreeWidget>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

// Texts that differ only in digits are one event of the agent.
EventText chatter(int number) {
    const std::array letters{static_cast<char>('a' + number / 676),
                             static_cast<char>('a' + number / 26 % 26),
                             static_cast<char>('a' + number % 26)};
    return EventText{"chatter "} << std::string_view{letters.data(), letters.size()};
}

QString said(int number) {
    const EventText text = chatter(number);
    return QString::fromUtf8(text.view().data(), static_cast<int>(text.view().size()));
}

// An agent of this process, "robot", that chatters and is in Fault as it is told.
class TalkingAgent {
public:
    TalkingAgent() {
        cluster_.trigger = nullptr;
        cluster_.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{5});
        cluster_.cluster->addInterface<comms::DdsInterface>(ownNetwork());
        Probe& drive = cluster_.probe("/drive");
        drive.onActive = [this](Probe& probe, const Tick&) {
            if (fails) probe.fault(7, "the axis does not follow");
        };
        cluster_.probe("/talker").onStandby = [this](Probe& probe, const Tick&) {
            for (int i = 0; i < 20 && toSay > 0; ++i, --toSay)
                probe.event(Severity::Info, chatter(toSay));
        };
        cluster_.start();
    }
    ~TalkingAgent() { cluster_.cluster->stop(); }  // before its hooks go
    TalkingAgent(const TalkingAgent&) = delete;
    TalkingAgent& operator=(const TalkingAgent&) = delete;

    std::atomic<int> toSay{0};
    std::atomic<bool> fails{false};

private:
    ProbeCluster cluster_{{}, "robot"};
};

class PastWindow : public testing::Test {
protected:
    // A person's tool starts the drive. It is gone when the window comes.
    static bool alice(const char* whatSheDoes) {
        Session session{ownNetwork(), "alice"};
        if (!comes([&] { return session.frame()->find("/drive").has_value(); })) return false;
        const auto number = session.send("/drive", whatSheDoes);
        std::vector<CommandOutcome> outcomes;
        return comes([&] {
            for (auto& each : session.takeOutcomes()) outcomes.push_back(std::move(each));
            return !outcomes.empty() && outcomes.front().number == number &&
                   outcomes.front().answer.done();
        });
    }
    void openWindow() {
        session.emplace(ownNetwork(), "bob");
        window = std::make_unique<MainWindow>(*session);
        window->show();
        window->openKind("events");
    }
    ~PastWindow() override {
        window.reset();
        session.reset();
    }
    EventView& view() { return *qobject_cast<EventView*>(window->current()); }
    EventTable& table() { return *view().findChild<EventTable*>(); }
    std::optional<int> rowWith(const QString& text) {
        const auto& rows = *table().model();
        for (int row = 0; row < rows.rowCount(); ++row)
            if (rows.index(row, EventModel::Text).data().toString().contains(text)) return row;
        return std::nullopt;
    }
    bool says(const QString& text) {
        for (const auto* each : window->current()->findChildren<TextLabel*>())
            if (each->isVisible() && each->text().contains(text)) return true;
        return false;
    }
    FaultHistoryView* before() { return qobject_cast<FaultHistoryView*>(window->current()); }
    // "Kind Path What" of each row.
    QStringList linesBefore() {
        QStringList lines;
        const auto* rows = before()->findChild<QTreeWidget*>();
        for (int i = 0; i < rows->topLevelItemCount(); ++i) {
            const auto& row = *rows->topLevelItem(i);
            lines << row.text(1) + ' ' + row.text(2) + ' ' + row.text(3);
        }
        return lines;
    }

    std::optional<TalkingAgent> robot{std::in_place};
    std::optional<Session> session;
    std::unique_ptr<MainWindow> window;
};

TEST_F(PastWindow, ShowsTheCommandOfBeforeAFloodOfChatterWithItsPerson) {
    ASSERT_TRUE(alice("startup"));
    robot->toSay = 1'500;
    ASSERT_TRUE(comesWithoutEvents([&] { return robot->toSay == 0; }));
    openWindow();
    ASSERT_TRUE(comes([&] { return rowWith(said(1)).has_value(); }));
    ASSERT_TRUE(comes([&] { return rowWith("alice (cortex-explorer@").has_value(); }));
    EXPECT_TRUE(rowWith("): startup(): Done"));
    EXPECT_FALSE(rowWith(said(1'500))) << "its live events reach back less";
    EXPECT_TRUE(comes([&] { return says("robot: keeps what happened since "); }));
    EXPECT_TRUE(says("Changes of values are known until ") &&
                says("; Last hour asks again. robot"));
    EXPECT_EQ(*rowWith("): startup(): Done") < *rowWith(said(1)), true);
    EXPECT_EQ(table().model()->rowCount(), [&] {
        std::set<QString> all;
        for (int row = 0; row < table().model()->rowCount(); ++row) {
            QString line;
            for (int column = 0; column < EventModel::ColumnCount; ++column)
                line += table().model()->index(row, column).data().toString() + '\n';
            all.insert(line);
        }
        return static_cast<int>(all.size());
    }()) << "none is there twice";
    window->open("/drive");
    EXPECT_TRUE(comes([&] { return says("since ") && !says("since before"); }))
        << "it remembers also when the drive became Active";
}

TEST_F(PastWindow, TheLineOfAFaultOpensTheTenSecondsBeforeIt) {
    openWindow();
    ASSERT_TRUE(comes([&] { return session->frame()->complete && window->ready(); }));
    ASSERT_TRUE(alice("startup"));
    robot->fails = true;
    ASSERT_TRUE(comes([&] { return rowWith("fault 7: the axis does not follow").has_value(); }));
    const int tabs = window->workspace().panes()[0]->count();
    table().setCurrentIndex(
        table().model()->index(*rowWith("fault 7: the axis does not follow"), 0));
    QTest::keyClick(&table(), Qt::Key_Return);
    ASSERT_NE(before(), nullptr);
    ASSERT_TRUE(comes([&] { return before()->settled(); }));
    const QStringList lines = linesBefore();
    const int commanded = lines.indexOf(QRegularExpression{
        "^command /drive alice \\(cortex-explorer@.*\\): startup\\(\\): Done.*"});
    const int active = lines.indexOf("state change /drive StartingUp -> Active");
    EXPECT_GE(commanded, 0) << lines.join('\n').toStdString();
    EXPECT_GE(active, 0) << lines.join('\n').toStdString();
    EXPECT_EQ(lines.back(), "fault /drive fault 7: the axis does not follow");
    EXPECT_EQ(lines.filter("fault 7").size(), 1);
    auto* rows = before()->findChild<QTreeWidget*>();
    EXPECT_FALSE(rows->topLevelItem(lines.size() - 1)->icon(1).isNull()) << "it is marked";

    rows->setCurrentItem(rows->topLevelItem(lines.size() - 1));
    QTest::keyClick(rows, Qt::Key_Return);
    EXPECT_EQ(window->workspace().path(), "/drive");
    ASSERT_TRUE(comes([&] {
        const auto* area = window->current()->findChild<MessageArea*>();
        for (auto* each : area->findChildren<QAbstractButton*>())
            if (each->isVisible() && each->accessibleName().endsWith("Ten seconds before")) {
                each->click();
                return true;
            }
        return false;
    }));
    EXPECT_NE(before(), nullptr);
    EXPECT_EQ(window->workspace().panes()[0]->count(), tabs + 1) << "it has one tab";
}

TEST_F(PastWindow, OfAnAgentThatIsGoneItHasWhatItHeardAndSaysSo) {
    openWindow();
    ASSERT_TRUE(comes([&] { return session->frame()->complete && window->ready(); }));
    ASSERT_TRUE(alice("startup"));
    robot->fails = true;
    ASSERT_TRUE(comes([&] { return rowWith("fault 7").has_value(); }));
    robot.reset();
    ASSERT_TRUE(comes([&] { return rowWith("agent ended").has_value(); }));
    table().setCurrentIndex(table().model()->index(*rowWith("fault 7"), 0));
    QTest::keyClick(&table(), Qt::Key_Return);
    ASSERT_NE(before(), nullptr);
    ASSERT_TRUE(comes([&] { return before()->settled(); }));
    EXPECT_TRUE(says("robot: it is not heard"));
    EXPECT_EQ(linesBefore().filter("alice (").size(), 1);
    EXPECT_EQ(linesBefore().back(), "fault /drive fault 7: the axis does not follow");
}

// One that says of itself what agents said before they kept anything.
TEST_F(PastWindow, AnAgentThatKeepsNothingIsNamed) {
    comms::Participant participant{ownNetwork(), "zoo"};
    const auto writer = participant.writer<comms::Presence>(comms::topics::presence);
    comms::Presence presence;
    presence.agent = comms::agentId("zoo");
    presence.name = "zoo";
    presence.host = "desk";
    presence.epoch = 1'700'000'000'000'000;
    presence.role = "agent";
    presence.state = "running";
    presence.majors = {1};
    QTimer alive;
    QObject::connect(&alive, &QTimer::timeout, [&] { writer->write(presence); });
    alive.start(50);
    openWindow();
    EXPECT_TRUE(comes([&] {
        return says("zoo: it was built before agents kept a memory: only its last 1,000 events");
    }));
}

}  // namespace
}  // namespace cortex::test
