// SPDX-License-Identifier: Apache-2.0
// Items that are set in the table of data, with a real agent over DDS.
#include "gui/editing.hpp"
#include "views/command_card.hpp"
#include "widgets/entry_hint.hpp"
#include "widgets/question.hpp"
#include "widgets/value_field.hpp"

#include <QAction>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QTimer>

namespace cortex::test {
namespace {

TEST_F(Editing, SendsNothingBeforeControlIsTakenAndThenSetsAndUndoes) {
    ASSERT_TRUE(isReady());
    const QString before = valueOf("dampingRatio");
    enters("dampingRatio", "0.75", Qt::Key_Return);
    EXPECT_TRUE(says("Not sent: read-only: take control of /drive"));
    EXPECT_FALSE(button("Set").isEnabled());
    EXPECT_EQ(valueOf("dampingRatio"), "0.75") << "what was entered stays";
    ASSERT_TRUE(takes("/drive"));
    ASSERT_TRUE(comes([this] { return button("Set").isEnabled(); }));
    EXPECT_TRUE(says("Not sent yet.")) << "what held it up is over";
    button("Set").click();
    EXPECT_TRUE(says("Set: dampingRatio "));
    EXPECT_TRUE(comes([this] { return valueOf("dampingRatio").startsWith("0.75"); }));
    EXPECT_NE(live({"show", "/drive"}).output.find("0.75"), std::string::npos);
    ASSERT_TRUE(comes([this] { return button("Undo").isVisible(); }));
    button("Undo").click();
    EXPECT_TRUE(says("Undone: dampingRatio 0.75"));
    EXPECT_TRUE(comes([&] { return valueOf("dampingRatio") == before; }));
    EXPECT_TRUE(says("Undone: dampingRatio 0.75"));
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    ASSERT_EQ(live({"set", "/drive", "dampingRatio=0.95"}).exit, 0);
    EXPECT_TRUE(comes([this] { return bar().findChild<TextLabel*>()->text().isEmpty(); }))
        << "somebody else has set it since";
}

// The entry of the menu of a row that sets it.
QAction& setOf(ItemTable& table, const QModelIndex& cell) {
    table.setCurrentIndex(cell);
    QTimer::singleShot(0, [] { QApplication::activePopupWidget()->close(); });
    QContextMenuEvent menu{QContextMenuEvent::Keyboard, table.visualRect(cell).center(),
                           table.mapToGlobal({})};
    QApplication::sendEvent(table.viewport(), &menu);
    for (QAction* each : table.actions()) {
        if (each->text().startsWith("Set")) return *each;
    }
    throw std::runtime_error{"no such entry"};
}

TEST_F(Editing, TheMenuSaysWhyAnItemCannotBeSet) {
    ASSERT_TRUE(isReady());
    EXPECT_TRUE(setOf(table(), cellOf("dampingRatio")).isEnabled());
    EXPECT_FALSE(setOf(table(), cellOf("state")).isEnabled());
    EXPECT_EQ(setOf(table(), cellOf("state")).text(), "Set: state is not settable");
    EXPECT_EQ(setOf(table(), cellOf("dampingRatio")).text(), "Set…");
}

TEST_F(Editing, SetsSeveralItemsTogetherAndDiscardsThem) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/"));
    enters("dampingRatio", "0.8", Qt::Key_Tab);
    enters("naturalFrequency", "5", Qt::Key_Tab);
    EXPECT_TRUE(comes([this] { return button("Set").text() == "Set 2 items"; }));
    button("Discard").click();
    EXPECT_TRUE(comes([this] { return !bar().isVisible(); }));
    EXPECT_NE(valueOf("dampingRatio"), "0.8");
    enters("dampingRatio", "0.8", Qt::Key_Tab);
    enters("naturalFrequency", "5", Qt::Key_Return);
    EXPECT_TRUE(says("Set: dampingRatio "));
    EXPECT_TRUE(comes([this] { return valueOf("naturalFrequency").startsWith("5"); }));
}

TEST_F(Editing, EachCopiedCommandDoesTheSameInAShell) {
    ASSERT_TRUE(isReady());
    const auto copied = [](const QWidget& widget, const char* action) {
        for (QAction* each : widget.actions()) {
            if (each->text() == action) each->trigger();
        }
        return QApplication::clipboard()->text();
    };
    const auto shell = [](const QString& line) {
        const std::string programs = CORTEX_BINARY_DIR "/bin";
        return runProgram("/bin/sh", {"-c", "PATH=" + programs + ":$PATH; " + line.toStdString()});
    };
    table().setCurrentIndex(cellOf("dampingRatio"));
    EXPECT_EQ(copied(table(), "Copy value"), "0.9");
    EXPECT_EQ(copied(table(), "Copy path"), "/drive.dampingRatio");
    EXPECT_NE(shell(copied(table(), "Copy as cortex command") + " --count 1").output.find("0.9"),
              std::string::npos);
    enters("dampingRatio", "0.8", Qt::Key_Tab);
    table().setCurrentIndex(cellOf("dampingRatio"));
    EXPECT_EQ(shell(copied(table(), "Copy as cortex command")).exit, 0);
    const auto place = session.frame()->find("/drive");
    ASSERT_TRUE(place);
    EXPECT_TRUE(comes([&] {
        const auto frame = session.frame();
        const AgentFrame& mixer = frame->agents[place->agent];
        const ItemLayout* item = frame->info(*place).layout->find("dampingRatio");
        return (*mixer.image)->value(place->simplex, *item) == Value{std::vector{0.8}};
    }));
    for (auto* each : window.current()->findChildren<CommandCard*>()) {
        if (each->command().name != "startup") continue;
        EXPECT_EQ(shell(copied(*each, "Copy as cortex command")).exit, 0);
    }
    EXPECT_TRUE(comes([this] { return valueOf("state") == "Active (2)"; }));
}

TEST_F(Editing, DoesNotTakeWhatIsOutOfTheRange) {
    ASSERT_TRUE(isReady());
    enters("naturalFrequency", "1e6", Qt::Key_Return);
    EXPECT_TRUE(says("naturalFrequency is out of the range"))
        << bar().findChild<TextLabel*>()->text().toStdString();
    EXPECT_TRUE(valueOf("naturalFrequency").startsWith("12"));
}

TEST_F(Editing, AFieldSaysWhileTypingWhatIsWrongAndMovesNothing) {
    ASSERT_TRUE(isReady());
    table().setCurrentIndex(cellOf("naturalFrequency"));
    QKeyEvent edit{QEvent::KeyPress, Qt::Key_F2, Qt::NoModifier};
    QApplication::sendEvent(&table(), &edit);
    ASSERT_NE(field(), nullptr);
    auto* hint = table().findChild<EntryHint*>();
    ASSERT_NE(hint, nullptr);
    EXPECT_FALSE(hint->isVisible());
    for (int i = 0; i < 5; ++i) QApplication::processEvents();  // it is laid out
    const QRect place = table().geometry(), row = table().visualRect(table().currentIndex());
    field()->selectAll();
    QTest::keyClicks(field(), "1e6");
    for (int i = 0; i < 5; ++i) QApplication::processEvents();
    EXPECT_TRUE(hint->isVisible());
    EXPECT_TRUE(hint->text().contains("out of the range")) << hint->text().toStdString();
    EXPECT_FALSE(hint->geometry().intersects(field()->geometry()));
    EXPECT_TRUE(table().viewport()->rect().contains(hint->geometry()));
    EXPECT_EQ(table().geometry(), place);
    EXPECT_EQ(table().visualRect(table().currentIndex()), row);
    field()->selectAll();
    QTest::keyClicks(field(), "5");
    EXPECT_FALSE(hint->isVisible());
    QTest::keyClicks(field(), "e6");
    EXPECT_TRUE(hint->isVisible());
    QTest::keyClick(field(), Qt::Key_Escape);
    EXPECT_FALSE(hint->isVisible());
}

TEST_F(Editing, TheKeyboardIsInTheTableAfterSetting) {
    ASSERT_TRUE(isReady());
    window.activateWindow();
    ASSERT_TRUE(takes("/drive"));
    for (const char* pressed : {"Discard", "Set"}) {
        enters("dampingRatio", "0.75", Qt::Key_Tab);
        if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
        ASSERT_TRUE(comes([&] { return button(pressed).isEnabled(); }));
        button(pressed).setFocus();
        QTest::keyClick(&button(pressed), Qt::Key_Space);
        EXPECT_EQ(QApplication::focusWidget(), &table()) << pressed;
    }
    EXPECT_TRUE(says("Set: dampingRatio "));
    EXPECT_EQ(QApplication::focusWidget(), &table());
    for (const bool byButton : {true, false}) {
        ASSERT_TRUE(comes([&] { return button("Undo").isVisible(); }));
        if (byButton) button("Undo").setFocus();
        byButton ? QTest::keyClick(&button("Undo"), Qt::Key_Space)
                 : QTest::keyClick(&table(), Qt::Key_Z, Qt::ControlModifier);
        EXPECT_TRUE(says("Undone: dampingRatio 0.75"));
        EXPECT_EQ(QApplication::focusWidget(), &table());
        EXPECT_TRUE(comes([&] { return valueOf("dampingRatio") == "0.9"; }));
        enters("dampingRatio", "0.75", Qt::Key_Return);
        EXPECT_TRUE(says("Set: dampingRatio "));
    }
}

TEST_F(Editing, AWrongFieldKeepsWhatWasTyped) {
    ASSERT_TRUE(isReady());
    enters("naturalFrequency", "1e6", Qt::Key_Return);
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "1e6");
    EXPECT_TRUE(says("naturalFrequency is out of the range"));
    QFocusEvent leaves{QEvent::FocusOut};
    QApplication::sendEvent(field(), &leaves);
    QApplication::processEvents();
    ASSERT_NE(field(), nullptr);
    EXPECT_EQ(field()->text(), "1e6");
    field()->setText("5");
    QTest::keyClick(field(), Qt::Key_Tab);
    QApplication::processEvents();
    EXPECT_EQ(valueOf("naturalFrequency"), "5");
}

TEST_F(Editing, WhatWasRefusedIsForgottenWithTheValueThatIsPutRight) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    enters("dampingRatio", "0.8", Qt::Key_Tab);
    if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
    enters("naturalFrequency", "5", Qt::Key_Tab);
    if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
    ASSERT_TRUE(comes([this] { return button("Set").text() == "Set 2 items"; }));
    enters("naturalFrequency", "1e6", Qt::Key_Return);
    ASSERT_TRUE(says("naturalFrequency is out of the range"));
    ASSERT_NE(field(), nullptr);
    field()->setText("5");  // as it was before
    QTest::keyClick(field(), Qt::Key_Tab);
    EXPECT_TRUE(says("Not sent yet."));
    EXPECT_EQ(button("Set").text(), "Set 2 items");
}

TEST_F(Editing, WhatWasRefusedIsForgottenWhenItIsGivenUp) {
    ASSERT_TRUE(isReady());
    enters("naturalFrequency", "1e6", Qt::Key_Return);
    ASSERT_TRUE(says("naturalFrequency is out of the range"));
    QTest::keyClick(field(), Qt::Key_Escape);
    EXPECT_TRUE(comes([this] { return bar().findChild<TextLabel*>()->text().isEmpty(); }));
}

class EditingArrays : public Editing {
protected:
    EditingArrays() : Editing{"AxisPoseController"} {}
    // The n-th element of the pose, from 1.
    QModelIndex element(int number) {
        const QModelIndex pose = cellOf("pose").siblingAtColumn(0);
        table().expand(pose);
        return table().model()->index(number - 1, ItemModel::Value, pose);
    }
    // In brackets in Standby, in which the controller writes nothing.
    bool shows(int number, const QString& text) {
        return element(number).data() == text || element(number).data() == '[' + text + ']';
    }
    void enters(int number, const QString& text, Qt::Key key) {
        type(element(number), "pose", text, key);
    }
};

TEST_F(EditingArrays, ElementsAreEnteredOneByOne) {
    ASSERT_TRUE(everythingComes());
    window.open("/controller");
    window.openPart("data");
    ASSERT_TRUE(comes([this] { return shows(2, "0"); }));
    ASSERT_TRUE(takes("/controller"));
    enters(2, "0.25", Qt::Key_Tab);
    EXPECT_EQ(element(2).data(), "0.25");
    EXPECT_TRUE(shows(4, "0"));
    for (int i = 0; i < 3 && field() != nullptr; ++i) QTest::keyClick(field(), Qt::Key_Backtab);
    EXPECT_TRUE(field() == nullptr || !field()->text().contains(' '))
        << "the whole array is passed by, as its elements are open";
    if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
    enters(3, "abc", Qt::Key_Tab);
    EXPECT_TRUE(says("pose 3: number expected"));
    ASSERT_NE(field(), nullptr);
    const auto frames = session.frame()->number;
    EXPECT_TRUE(comes([&] { return session.frame()->number > frames + 3; }));
    EXPECT_TRUE(says("pose 3: number expected")) << "it stays as long as it is there";
    QTest::keyClick(field(), Qt::Key_Escape);
    EXPECT_TRUE(says("Not sent yet."));
    // What others set meanwhile of the rest stays.
    ASSERT_TRUE(comes([this] { return button("Set").isEnabled(); }));
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    ASSERT_EQ(live({"set", "/controller", "pose=9 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"}).exit, 0);
    ASSERT_TRUE(comes([this] { return shows(1, "9"); }));
    ASSERT_TRUE(takes("/controller"));
    ASSERT_TRUE(comes([this] { return button("Set").isEnabled(); }));
    button("Set").click();
    EXPECT_TRUE(says("Set: pose "));
    EXPECT_TRUE(comes([this] {
        const auto frame = session.frame();
        const auto place = frame->find("/controller");
        const ItemLayout* item = frame->info(*place).layout->find("pose");
        std::vector<double> pose(16);
        pose[0] = 9;
        pose[1] = 0.25;
        return (*frame->agents[place->agent].image)->value(place->simplex, *item) == Value{pose};
    }));
}

TEST_F(Editing, WillNotUndoWhatAnotherStartOfTheAgentHadSet) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    enters("dampingRatio", "0.8", Qt::Key_Return);
    ASSERT_TRUE(says("Set: dampingRatio "));
    const auto startNow = [this] {
        const auto frame = session.frame();
        const auto place = frame->find("/drive");
        return place ? frame->agents[place->agent].status.epoch : 0;
    };
    const auto before = startNow();
    agent.reset();
    start();
    ASSERT_TRUE(comes([&] { return startNow() > before; }));
    window.refresh();
    bar().undo();
    EXPECT_TRUE(says("Not undone: the agent has started anew since."))
        << bar().findChild<TextLabel*>()->text().toStdString();
}

TEST_F(Editing, TheWindowAsksBeforeItForgetsWhatIsTypedAndNotSent) {
    ASSERT_TRUE(isReady());
    const auto asks = [this](const QString& wanted) {
        EXPECT_FALSE(window.close());
        bool said = false;
        for (auto* each : window.findChildren<Question*>()) {
            if (!each->isVisible()) continue;
            for (const auto* label : each->findChildren<TextLabel*>())
                said = said || label->text() == wanted;
            each->no().click();
        }
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        return said;
    };
    window.open("/mixer");
    window.openPart("commands");
    window.refresh();
    auto* form = window.current()->findChild<ValueField*>();
    ASSERT_NE(form, nullptr);
    form->setText("1");
    EXPECT_TRUE(asks("1 entered value, not sent, is forgotten."));
    form->setText({});
    ASSERT_TRUE(isReady());
    table().setCurrentIndex(cellOf("dampingRatio"));
    QTest::keyClick(&table(), '7');
    ASSERT_NE(field(), nullptr);
    EXPECT_TRUE(asks("1 entered value, not sent, is forgotten."));
    if (field() != nullptr) QTest::keyClick(field(), Qt::Key_Escape);
    bar().discard();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_TRUE(window.close()) << "nothing is lost";
}

TEST_F(Editing, WillNotUndoWhatSomebodyElseHasSetSince) {
    ASSERT_TRUE(isReady());
    ASSERT_TRUE(takes("/drive"));
    enters("dampingRatio", "0.75", Qt::Key_Return);
    ASSERT_TRUE(says("Set: dampingRatio "));
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    ASSERT_EQ(live({"set", "/drive", "dampingRatio=0.95"}).exit, 0);
    ASSERT_TRUE(comes([this] { return valueOf("dampingRatio").startsWith("0.95"); }));
    button("Undo").click();
    EXPECT_TRUE(says("Not undone: somebody else has set dampingRatio since."));
}

}  // namespace
}  // namespace cortex::test
