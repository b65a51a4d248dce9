// SPDX-License-Identifier: Apache-2.0
// What is entered in forms, and what is said of commands.
#include "model/outcome_text.hpp"
#include "model/shell_text.hpp"
#include "session/typed_arguments.hpp"
#include "widgets/popover.hpp"
#include "widgets/value_field.hpp"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <gtest/gtest.h>

namespace cortex::gui {
namespace {

DataItem itemOfKind(Kind kind) {
    DataItem item;
    item.name = "value";
    item.kind = kind;
    if (kind == Kind::Float) item.initial = std::vector{0.0};
    if (kind == Kind::Int) item.initial = std::vector<std::int64_t>{0};
    if (kind == Kind::Bool) item.initial = std::vector<bool>{false};
    return item;
}

void turnWheel(QWidget& widget) {
    QWheelEvent wheel{{5, 5}, {5, 5}, {0, 0}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false};
    QApplication::sendEvent(&widget, &wheel);
}

TEST(Field, SaysWhatIsWrongWhileTyping) {
    DataItem item = itemOfKind(Kind::Float);
    item.min = 0.5;
    item.max = 15.0;
    ValueField field{item};
    EXPECT_TRUE(field.isEmpty() && field.problem().isEmpty());
    field.setText("99");
    EXPECT_TRUE(field.problem().contains("range")) << field.problem().toStdString();
    EXPECT_FALSE(field.value());
    field.setText("abc");
    EXPECT_FALSE(field.problem().isEmpty());
    field.setText(QString::fromUtf8("1.5"));
    EXPECT_EQ(field.value(), Value{std::vector{1.5}});
}

TEST(Field, GivesTheKeyboardToTheChoiceThatIsChosen) {
    DataItem item = itemOfKind(Kind::Int);
    item.labels = {{0, "Position"}, {1, "Velocity"}};
    item.hasDefault = true;
    item.initial = std::vector<std::int64_t>{1};
    ValueField field{item};
    const auto buttons = field.findChildren<QPushButton*>();
    EXPECT_EQ(field.focusProxy(), buttons[1]);
    field.setText("Position");
    EXPECT_EQ(field.focusProxy(), buttons[0]);
    buttons[1]->click();
    EXPECT_EQ(field.focusProxy(), buttons[1]);
}

TEST(Popovers, EnterPressesTheButtonThatHasTheKeyboard) {
    Popover popover{"Choose"};
    QPushButton one{"one"}, other{"other"};
    QComboBox list;
    list.addItems({"first", "second"});
    int pressed = 0;
    QObject::connect(&other, &QPushButton::clicked, [&] { ++pressed; });
    for (QWidget* each : std::initializer_list<QWidget*>{&one, &other, &list})
        popover.rows().addWidget(each);
    popover.setAttribute(Qt::WA_DeleteOnClose, false);
    popover.show();
    const auto enter = [](QWidget& to, bool again = false) {
        to.setFocus();
        QKeyEvent key{QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, {}, again};
        QApplication::sendEvent(&to, &key);
    };
    enter(one);
    EXPECT_EQ(pressed, 0);
    enter(other);
    EXPECT_EQ(pressed, 1);
    enter(other, true);
    EXPECT_EQ(pressed, 1) << "a key that is held down presses once";
    enter(list);
    EXPECT_TRUE(list.view()->isVisible());
    list.hidePopup();
}

TEST(Field, TakesTheMinusSignThatTheWindowShows) {
    ValueField field{itemOfKind(Kind::Float)};
    field.setText(QString::fromUtf8("−2.5"));
    EXPECT_EQ(field.value(), Value{std::vector{-2.5}});
}

TEST(Field, HasButtonsForAFewLabelsAndAListForMany) {
    DataItem item = itemOfKind(Kind::Int);
    item.labels = {{0, "Position"}, {1, "Velocity"}};
    ValueField few{item};
    EXPECT_EQ(few.findChildren<QPushButton*>().size(), 2);
    EXPECT_TRUE(few.isEmpty()) << "nothing is chosen for the user";
    few.setText("Velocity");
    EXPECT_EQ(few.value(), Value{std::vector<std::int64_t>{1}});
    for (int i = 2; i < 6; ++i) item.labels[i] = "Mode" + std::to_string(i);
    ValueField many{item};
    auto* list = many.findChild<QComboBox*>();
    ASSERT_NE(list, nullptr);
    EXPECT_TRUE(many.isEmpty());
    many.setText("Mode3");
    turnWheel(*list);
    EXPECT_EQ(many.value(), Value{std::vector<std::int64_t>{3}}) << "the wheel only scrolls";
    ValueField yesOrNo{itemOfKind(Kind::Bool)};
    yesOrNo.setText("true");
    EXPECT_EQ(yesOrNo.value(), Value{std::vector<bool>{true}});
}

TEST(Field, HasAnAmpersandInALabelWholeOnItsButtonAndMakesNoKeyOfIt) {
    DataItem item = itemOfKind(Kind::Int);
    item.labels = {{0, "R&D"}, {1, "&amp;"}};
    ValueField field{item};
    QStringList shown;
    for (auto* each : field.findChildren<QPushButton*>()) {
        EXPECT_TRUE(each->shortcut().isEmpty()) << each->shortcut().toString().toStdString();
        shown << each->text().replace("&&", "&");  // as Qt paints it
    }
    EXPECT_EQ(shown, (QStringList{"R&D", "&amp;"}));
    field.findChildren<QPushButton*>().front()->click();
    EXPECT_EQ(field.value(), Value{std::vector<std::int64_t>{0}});
    field.setText("&amp;");
    EXPECT_EQ(field.value(), Value{std::vector<std::int64_t>{1}});
}

TEST(Field, TakesAllElementsOfAnArrayOrNone) {
    DataItem item = itemOfKind(Kind::Float);
    item.length = 3;
    item.initial = std::vector{0.0, 0.0, 0.0};
    ValueField field{item};
    field.setText("1 2");
    EXPECT_FALSE(field.value());
    EXPECT_FALSE(field.problem().isEmpty());
    field.setText("1 2 3");
    EXPECT_EQ(field.value(), (Value{std::vector{1.0, 2.0, 3.0}}));
}

CommandOutcome answered(Outcome outcome, Reason reason = Reason::None, std::string why = {}) {
    CommandOutcome result;
    result.answer.outcome = outcome;
    result.answer.reason = reason;
    result.answer.why = std::move(why);
    return result;
}

TEST(OutcomeText, SaysWhatBecameOfACommandAndWhatToDo) {
    EXPECT_TRUE(outcomeText(answered(Outcome::Done)).startsWith("Done  "));
    EXPECT_EQ(outcomeText(answered(Outcome::Rejected, Reason::Range, "speed: 2 is above 1")),
              "Rejected (range): speed: 2 is above 1");
    EXPECT_TRUE(outcomeText(answered(Outcome::Unknown)).contains("may have been executed"));
    EXPECT_EQ(outcomeText(answered(Outcome::Expired)),
              "Not executed: it reached the agent too late.");
    EXPECT_EQ(outcomeText(answered(Outcome::Rejected, Reason::Restarted)),
              "Not executed: the agent had started anew.");
    CommandOutcome never;
    never.problem = "no agent has /x";
    EXPECT_EQ(outcomeText(never), "Not sent: no agent has /x");
}

TEST(OutcomeText, ShowsWhatACommandGives) {
    Command command;
    command.response.push_back(itemOfKind(Kind::Float));
    command.response.back().unit = "m";
    CommandOutcome outcome = answered(Outcome::Done);
    outcome.answer.response["value"] = std::vector{-0.5};
    EXPECT_TRUE(outcomeText(outcome, &command).endsWith(QString::fromUtf8("\nvalue = −0.5 m")));
}

TEST(TypedArguments, AreForgottenWhereTheParameterMeansSomethingElse) {
    TypedArguments typed;
    const TypedArguments::Key key{"/arm", "turn", "value"};
    DataItem angle = itemOfKind(Kind::Float);
    angle.unit = "deg";
    typed.keep(key, angle, "2");
    EXPECT_EQ(typed.of(key, angle), "2");
    DataItem other = angle;
    other.description = "How far.";
    EXPECT_EQ(typed.of(key, other), "2");
    other.unit = "rad";
    EXPECT_EQ(typed.of(key, other), "");
    other = angle;
    other.labels = {{2, "Ten"}};
    EXPECT_EQ(typed.of(key, other), "");
    other = angle;
    other.length = 2;
    EXPECT_EQ(typed.of(key, other), "");
    other = angle;
    other.kind = Kind::Int;
    EXPECT_EQ(typed.of(key, other), "");
}

TEST(TypedArguments, AreUnsentUntilTheirCommandIsAndWhenTheyAreTypedAnew) {
    TypedArguments typed;
    const DataItem item = itemOfKind(Kind::Float);
    typed.keep({"/arm", "turn", "value"}, item, "2");
    typed.keep({"/arm", "move", "value"}, item, "3");
    EXPECT_EQ(typed.unsent(), 2);
    typed.noteSent("/arm", "turn");
    EXPECT_EQ(typed.unsent(), 1);
    typed.keep({"/arm", "turn", "value"}, item, "4");
    typed.keep({"/arm", "move", "value"}, item, {});
    EXPECT_EQ(typed.unsent(), 1);
}

TEST(ShellText, IsQuotedForAShell) {
    comms::NetworkOptions network;
    network.domain = 7;
    network.interfaces = {"lo"};
    network.security = "my keys";
    EXPECT_EQ(shellText(network, "call", "/arm", "say", {{"text", std::string{"it's 5"}}}),
              "cortex call /arm say 'text=it'\\''s 5' --domain 7 --interface lo "
              "--security 'my keys'");
    network = {};
    network.domain = 0;
    network.interfaces.clear();
    network.security.clear();
    EXPECT_EQ(shellText(network, "set", "/a", {}, {{"gain", 0.5}}), "cortex set /a gain=0.5");
}

}  // namespace
}  // namespace cortex::gui
