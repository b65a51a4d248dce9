// SPDX-License-Identifier: Apache-2.0
// What the window says of items that it has sent: on their way, without an answer, set by somebody
// else since.
#include "gui/editing.hpp"
#include "model/event_model.hpp"
#include "views/event_list.hpp"

#include <QAbstractItemView>
#include <csignal>

namespace cortex::test {
namespace {

// The line below while a set is on its way, and what it says then.
class SlowAgent : public Editing {
protected:
    void keeps(const QString& item, const QString& text) {
        enters(item, text, Qt::Key_Tab);
        if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
    }
    QString said() {
        window.refresh();
        return bar().findChild<TextLabel*>()->text();
    }
};

TEST_F(SlowAgent, WhatWasNotAnsweredMayHaveBeenExecutedAndIsSetOnceTheAgentHasIt) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    keeps("dampingRatio", "0.8");
    keeps("naturalFrequency", "5");
    ASSERT_TRUE(comes([this] { return button("Set").text() == "Set 2 items"; }));
    ASSERT_TRUE(comes([this] { return button("Set").isEnabled(); }));
    agent->send(SIGSTOP);
    button("Set").click();
    EXPECT_EQ(said(), "Sending…");
    EXPECT_FALSE(button("Set").isEnabled());
    EXPECT_FALSE(button("Discard").isEnabled());
    ASSERT_TRUE(comes([this] { return said() != "Sending…"; }));
    EXPECT_TRUE(said().startsWith("No answer came. The command may have been executed."))
        << said().toStdString();
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    EXPECT_TRUE(said().startsWith("No answer came.")) << said().toStdString();
    agent->send(SIGCONT);
    EXPECT_TRUE(says("Set: dampingRatio 0.9 → 0.8, naturalFrequency 12 → 5"));
    EXPECT_FALSE(button("Set").isVisible()) << "nothing is pending any longer";
}

TEST_F(SlowAgent, WhatIsEnteredWhileASetIsOnItsWayStays) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    agent->send(SIGSTOP);
    enters("dampingRatio", "0.8", Qt::Key_Return);
    ASSERT_EQ(said(), "Sending…");
    enters("naturalFrequency", "5", Qt::Key_Return);
    agent->send(SIGCONT);
    EXPECT_TRUE(says("Set: dampingRatio 0.9 → 0.8. Not sent yet: naturalFrequency"));
    EXPECT_EQ(button("Set").text(), "Set 1 item");
    EXPECT_EQ(valueOf("naturalFrequency"), "5");
}

TEST_F(SlowAgent, WhatIsEnteredWhileItIsNotHeardStaysAndSaysSo) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    enters("dampingRatio", "0.8", Qt::Key_Return);
    ASSERT_TRUE(says("Set: dampingRatio 0.9 → 0.8"));
    table().setCurrentIndex(cellOf("naturalFrequency"));
    QKeyEvent edit{QEvent::KeyPress, Qt::Key_F2, Qt::NoModifier};
    QApplication::sendEvent(&table(), &edit);
    QTest::keyClicks(field(), "11");
    agent->send(SIGSTOP);
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    window.refresh();
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "11");
    QTest::keyClick(field(), Qt::Key_Return);
    EXPECT_TRUE(says("Not sent: mixer is not heard"));
    EXPECT_EQ(valueOf("naturalFrequency"), "11");
}

TEST_F(Editing, WillNotUndoWhatSomebodyElseHasSetToTheSameValueSince) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    enters("dampingRatio", "0.75", Qt::Key_Return);
    ASSERT_TRUE(says("Set: dampingRatio "));
    window.open("/controller");  // none of what follows is seen in the table
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    ASSERT_EQ(live({"set", "/drive", "naturalFrequency=5"}).exit, 0);
    ASSERT_EQ(live({"set", "/drive", "dampingRatio=1"}).exit, 0);
    ASSERT_EQ(live({"set", "/drive", "dampingRatio=0.75"}).exit, 0);
    const auto& events = *window.findChild<EventList*>()->findChild<QAbstractItemView*>()->model();
    ASSERT_TRUE(comes([&] {
        for (int row = 0; row < events.rowCount(); ++row) {
            const QString text = events.index(row, EventModel::Text).data().toString();
            if (text.contains("set(dampingRatio=1)")) return true;
        }
        return false;
    }));
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    ASSERT_TRUE(comes([this] { return valueOf("dampingRatio").startsWith("0.75"); }));
    window.refresh();
    bar().undo();
    EXPECT_TRUE(says("Not undone: somebody else has set dampingRatio since."));
    EXPECT_TRUE(valueOf("dampingRatio").startsWith("0.75"));
}

}  // namespace
}  // namespace cortex::test
