// SPDX-License-Identifier: Apache-2.0
// What the window asks before it does something.
#include "widgets/question.hpp"

#include "gui/audit.hpp"
#include "gui/made_agent.hpp"
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "views/command_card.hpp"
#include "views/run_question.hpp"
#include "widgets/text_label.hpp"

#include <QLineEdit>
#include <QPushButton>
#include <QScreen>

#include <QtTest/QTest>
#include <gtest/gtest.h>

namespace cortex::test {
namespace {

class Asked : public testing::Test {
protected:
    Asked() {
        field.setGeometry(10, 10, 100, 30);
        button.setGeometry(10, 60, 100, 30);
        window.resize(400, 300);
        window.show();
        window.activateWindow();
        QApplication::processEvents();
        button.setFocus();
    }
    ~Asked() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }

    static DataItem number(const std::string& name, double initial) {
        DataItem item;
        item.name = name;
        item.kind = Kind::Float;
        item.unit = "m/s2";
        item.hasDefault = true;
        item.initial = std::vector{initial};
        return item;
    }
    static Command zero() {
        Command command;
        command.name = "zero";
        command.description = "Takes the position of now as zero.";
        command.request = {number("ramp", 0.5), number("speed", 1)};
        return command;
    }
    Question& ask(const std::string& path = "/drives/4") {
        return askToRun(window, button,
                        {path,
                         zero(),
                         {{"ramp", Value{std::vector{0.25}}}},
                         [] { return AgentStart{"robot"}; },
                         [this] { return whyNot; },
                         [this] { ++runs; }});
    }
    static QStringList textsOf(const Question& question) {
        QStringList texts;
        for (const auto* each : question.findChildren<TextLabel*>()) texts << each->text();
        return texts;
    }
    void press(Qt::Key key) {
        QTest::keyClick(QApplication::focusWidget(), key);
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    QWidget window;
    QLineEdit field{&window};
    QPushButton button{"Run", &window};
    QString whyNot;
    int runs = 0;
};

TEST_F(Asked, SaysTheCommandAndItsArgumentsWithUnitsOneALine) {
    const QStringList texts = textsOf(ask());
    EXPECT_EQ(texts.front(), "zero on /drives/4 of robot?");
    EXPECT_TRUE(texts.contains("Takes the position of now as zero."));
    EXPECT_TRUE(texts.contains(QString::fromUtf8("ramp = 0.25 m/s²")))
        << texts.join('|').toStdString();
    EXPECT_TRUE(texts.contains(QString::fromUtf8("speed = 1 m/s² (default)")));
}

TEST_F(Asked, EnterAndEscRunNothingAndTheKeyboardGoesBack) {
    for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Escape}) {
        const QPointer<Question> question = &ask();
        EXPECT_EQ(QApplication::focusWidget(), &question->no());
        press(key);
        EXPECT_FALSE(question) << key;
        EXPECT_EQ(runs, 0);
        EXPECT_EQ(window.focusWidget(), &button);
    }
}

TEST_F(Asked, AKeyThatIsHeldDownAnswersNothing) {
    Question& question = ask();
    question.yes().setFocus();
    for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter}) {
        QKeyEvent repeat{QEvent::KeyPress, key, Qt::NoModifier, {}, true};
        QApplication::sendEvent(&question.yes(), &repeat);
        QTest::keyClick(&question.yes(), key, Qt::ControlModifier);
    }
    EXPECT_EQ(runs, 0);
    EXPECT_TRUE(question.isVisible());
    QTest::keyClick(&question.yes(), Qt::Key_Return);
    EXPECT_EQ(runs, 1);
    EXPECT_FALSE(question.isVisible());
}

TEST_F(Asked, RunIsRefusedWithTheReasonWhereItCannotRunByNow) {
    Question& question = ask();
    const QRect before = question.geometry();
    whyNot = "read-only: take control of /drives";
    QTest::mouseClick(&question.yes(), Qt::LeftButton);
    EXPECT_EQ(runs, 0);
    EXPECT_TRUE(textsOf(question).contains(whyNot));
    EXPECT_FALSE(question.yes().isEnabled());
    EXPECT_EQ(question.geometry(), before);
    whyNot.clear();
    EXPECT_TRUE(comes([&] { return question.yes().isEnabled(); })) << "it is looked at again";
    EXPECT_FALSE(textsOf(question).contains("read-only: take control of /drives"));
    QTest::mouseClick(&question.yes(), Qt::LeftButton);
    EXPECT_EQ(runs, 1);
}

TEST(AskedOfAnAgent, IsRefusedWhereAnotherOneOrAnotherStartOfItHasThePathByNow) {
    const auto add = [](SimplexTree& tree) { tree.add("/worker", "Worker"); };
    MadeAgent asked{"forms2", add, "command-types.xml"}, other{"forms", add, "command-types.xml"};
    const auto frameWith = [](AgentFrame agent) {
        auto frame = frameOf({std::move(agent)});
        frame->control.held = {{frame->agents.front().status.name, "/", 1}};
        return frame;
    };
    const auto first = frameWith(asked.now());
    const gui::Place place = *first->find("/worker");
    Command command = *first->type(place).findCommand("mute");
    command.confirm = true;
    command.available = StateSet::always();
    Session session{ownNetwork()};
    Commands commands{session};
    CommandCard card{commands, "/worker", command};
    card.show();
    card.refresh(*first, place);
    card.run();
    auto* question = card.findChild<Question*>();
    ASSERT_NE(question, nullptr);
    const auto says = [&](const QString& text) {
        const auto labels = question->findChildren<TextLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) { return each->text() == text; });
    };
    EXPECT_TRUE(says("mute on /worker of forms2?"));
    card.refresh(*frameWith(other.now()), place);
    question->yes().click();
    EXPECT_TRUE(says("forms has /worker now, not forms2: ask again"));
    EXPECT_EQ(commands.last("/worker", "mute"), nullptr);
    AgentFrame again = asked.now();
    ++again.status.epoch;
    card.refresh(*frameWith(again), place);
    question->refuse({});
    question->yes().click();
    EXPECT_TRUE(says("forms2 has started anew: ask again"));
    EXPECT_EQ(commands.last("/worker", "mute"), nullptr);
    card.refresh(*first, place);
    question->refuse({});
    question->yes().click();
    EXPECT_NE(commands.last("/worker", "mute"), nullptr);
}

TEST_F(Asked, GoesWithWhatAsked) {
    const QPointer<Question> question = &ask();
    window.hide();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_FALSE(question);
    EXPECT_EQ(runs, 0);
}

TEST_F(Asked, LiesInsideOfTheScreenWithItsButtonsInSightWhateverTheTextsAre) {
    const QRect screen = window.screen()->availableGeometry();
    const std::string longWord(10'000, 'x');
    const std::string badText = "<h1>SAFE</h1> & \n\t\x1b[31m " + longWord;
    Look::apply(Theme::Light, 1.5, QStringLiteral("DejaVu Sans"));
    Command command = zero();
    command.name = command.description = command.request.front().name = badText;
    Question& question = askToRun(window, button,
                                  {badText,
                                   command,
                                   {},
                                   [&] { return AgentStart{badText}; },
                                   [] { return QString{}; },
                                   [] {}});
    for (int i = 0; i < 5; ++i) QApplication::processEvents();
    EXPECT_TRUE(screen.contains(question.frameGeometry()));
    for (const QPushButton* each : {&question.yes(), &question.no()}) {
        const QRect at{each->mapTo(&question, QPoint{}), each->size()};
        EXPECT_TRUE(question.rect().contains(at)) << each->text().left(40).toStdString();
    }
    for (const auto* each : question.findChildren<TextLabel*>())
        EXPECT_EQ(each->textFormat(), Qt::PlainText);
}

TEST_F(Asked, CanBeReadInEverySize) {
    for (const double scale : {1.0, 1.25, 1.5}) {
        Look::apply(Theme::Light, scale, QStringLiteral("Open Sans"));
        Question& question = ask("/levelling/platform/hydraulics/left_cell/valves/proportional");
        question.refuse("read-only: take control of /levelling");
        for (int i = 0; i < 5; ++i) QApplication::processEvents();
        EXPECT_EQ(unreadableIn(question).join('\n').toStdString(), "") << scale;
        question.close();
    }
}

}  // namespace
}  // namespace cortex::test
