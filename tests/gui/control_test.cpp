// SPDX-License-Identifier: Apache-2.0
// Control and commands from the window, with a real agent over DDS.
#include "gui/window_fixture.hpp"
#include "views/command_card.hpp"
#include "views/life_cycle_bar.hpp"
#include "widgets/text_label.hpp"
#include "widgets/value_field.hpp"
#include "window/control_bar.hpp"
#include "window/stop_button.hpp"

#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QRadioButton>
#include <QSet>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

class Controlling : public Window {
protected:
    bool takes(const std::string& prefix) {
        window.control().choose();
        window.control().panel()->choose(prefix);
        window.control().panel()->takeButton().click();
        return comes([&] { return window.control().prefix() == prefix; });
    }
    QPushButton& button(const QString& text) {
        const auto* bar = window.current()->findChild<LifeCycleBar*>();
        for (auto* each : bar->findChildren<QPushButton*>()) {
            if (each->text() == text) return *each;
        }
        throw std::runtime_error{"no such button"};
    }
    // Why the buttons of the life cycle cannot be pressed.
    bool says(const QString& reason) {
        window.refresh();
        const auto labels = window.current()->findChildren<TextLabel*>();
        return std::ranges::any_of(labels,
                                   [&](const auto* each) { return each->text().contains(reason); });
    }
    CommandCard& card(const std::string& command) {
        for (auto* each : window.current()->findChildren<CommandCard*>()) {
            if (each->command().name == command) return *each;
        }
        throw std::runtime_error{"no such command"};
    }
    bool isIn(const std::string& path, State state) {
        const auto frame = session.frame();
        const auto place = frame->find(path);
        return place && frame->agents[place->agent].state(place->simplex) == state;
    }
    static std::string leases() { return live({"leases"}).output; }
};

TEST_F(Controlling, IsReadOnlyAtFirstAndSaysHowToTakeControl) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    EXPECT_EQ(window.control().text(), "Read-only");
    EXPECT_FALSE(button("Startup").isEnabled());
    EXPECT_TRUE(says("read-only: take control of /drive"));
    EXPECT_TRUE(says("needs Fault"));
}

TEST_F(Controlling, TakesControlCommandsAndReleases) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    EXPECT_TRUE(window.control().text().startsWith("You control /drive since "));
    EXPECT_NE(leases().find("/drive"), std::string::npos);
    window.refresh();
    ASSERT_TRUE(button("Startup").isEnabled());
    EXPECT_TRUE(says("needs StartingUp or Active"));
    button("Startup").click();
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Active) && says("Startup: Done"); }));
    window.open("/controller");
    EXPECT_TRUE(says("read-only: take control of /controller")) << "it is beside what is held";
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_TRUE(comes([this] { return window.control().text() == "Read-only"; }));
    EXPECT_TRUE(comes([] { return leases().find("/drive") == std::string::npos; }));
    EXPECT_TRUE(isIn("/drive", State::Active)) << "releasing stops nothing";
}

TEST_F(Controlling, IsTakenByKeysAloneWithAFocusThatIsSeen) {
    ASSERT_TRUE(everythingComes());
    window.open("/axis/observed");
    QApplication::setActiveWindow(&window);
    QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier);
    ControlPanel* panel = window.control().panel();
    ASSERT_NE(panel, nullptr);
    const auto chosen = [&] {
        const auto all = panel->findChildren<QRadioButton*>();
        const auto found =
            std::ranges::find_if(all, [](const auto* each) { return each->isChecked(); });
        return found != all.end() ? *found : nullptr;
    };
    ASSERT_NE(chosen(), nullptr);
    EXPECT_EQ(panel->focusWidget(), chosen()) << "arrows choose at once";
    EXPECT_EQ(chosen()->text(), "/axis");
    QTest::keyClick(panel->focusWidget(), Qt::Key_Up);
    EXPECT_EQ(chosen()->text(), "/axis/observed");
    EXPECT_EQ(panel->takeButton().text(), "Take /axis/observed");
    QTest::keyClick(panel->focusWidget(), Qt::Key_Return);
    EXPECT_TRUE(comes([&] { return window.control().prefix() == "/axis/observed"; }));
}

// The ring around it, in the colour of the accent.
TEST_F(Controlling, EveryWidgetOfThePanelShowsThatItHasTheFocus) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    window.control().choose();
    ControlPanel* panel = window.control().panel();
    QApplication::setActiveWindow(panel);
    QWidget* const first = panel->focusWidget();
    ASSERT_NE(first, nullptr);
    QSet<const QWidget*> seen;
    do {
        QWidget* const widget = panel->focusWidget();
        seen.insert(widget);
        const QImage with = widget->grab().toImage();
        widget->clearFocus();
        const QImage without = widget->grab().toImage();
        widget->setFocus(Qt::TabFocusReason);
        EXPECT_NE(with, without) << widget->metaObject()->className();
        QTest::keyClick(widget, Qt::Key_Tab);
    } while (panel->focusWidget() != first && seen.size() < 10);
    EXPECT_TRUE(seen.contains(&panel->takeButton()));
    QTest::keyClick(panel, Qt::Key_Escape);
    EXPECT_FALSE(panel->isVisible());
}

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
        EXPECT_TRUE(comes([&] { return isHeld() && !window.control().noticeText().isEmpty(); }));
        EXPECT_EQ(window.control().noticeText(), "Control of / was not taken. mixer: " + holder +
                                                     " holds /drive, and must release it or "
                                                     "hand it over.");
        EXPECT_FALSE(window.control().holds());
    }
    EXPECT_TRUE(comes([this] { return says("read-only"); })) << "its end releases";
    EXPECT_TRUE(takes("/"));
    EXPECT_TRUE(window.control().noticeText().isEmpty());
}

// Another window of the same person or of a colleague, without a screen.
struct Colleague {
    bool sees(const char* path) const { return session.frame()->find(path).has_value(); }
    const Control& control() {
        session.isAlive();
        now = session.frame()->control;
        return now;
    }
    Session session{ownNetwork()};
    Control now;
};

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
    EXPECT_EQ(window.control().noticeText(), "Control of /drive was handed over to " + name + ".");
    EXPECT_TRUE(comes([&] { return other.control().held.size() == 1 && says("held by " + name); }));
    other.session.releaseControl();
    ASSERT_TRUE(comes([&] { return other.control().prefix.empty() && says("read-only"); }));
    EXPECT_EQ(window.control().takeAgainButton().text(), "Take /drive again");
    window.control().takeAgainButton().click();
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
    EXPECT_EQ(window.control().noticeText(), "Control of /drive of agent mixer is yours now.");
    // An agent ends a lease 2 s after its last renewal: 3,000 cycles of 1 ms are longer.
    const auto cycle = [this] { return session.frame()->agents.front().status.cycle; };
    const std::int64_t then = cycle();
    EXPECT_TRUE(comes([&] { return cycle() > then + 3000; }));
    EXPECT_EQ(window.control().prefix(), "/drive");
    EXPECT_NE(leases().find("/drive"), std::string::npos);
}

TEST(ControlOfSeveralParts, IsStoppedAtThePathAroundThem) {
    const auto commonOf = [](std::initializer_list<const char*> prefixes) {
        Control control;
        for (const char* each : prefixes) control.held.push_back({"robot", each, 0});
        return control.common();
    };
    EXPECT_EQ(commonOf({}), "");
    EXPECT_EQ(commonOf({"/arm"}), "/arm");
    EXPECT_EQ(commonOf({"/arm/left", "/arm/right/hand"}), "/arm");
    EXPECT_EQ(commonOf({"/arm", "/armature"}), "/");
}

TEST_F(Controlling, ANameThatNobodyHasEndsControlAndIsTold) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    session.handOver("nobody@nowhere.1-000000");
    EXPECT_TRUE(comes([&] { return !window.control().noticeText().isEmpty(); }));
    EXPECT_TRUE(comes([] { return leases().find("nobody@") == std::string::npos; }));
}

TEST_F(Controlling, AWindowThatHangsHoldsNothing) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(takes("/"));
    // No event is handled from here on, as in a window that hangs.
    EXPECT_TRUE(comesWithoutEvents([] { return leases().find("explorer@") == std::string::npos; }));
    EXPECT_TRUE(comes([this] { return !window.control().holds(); }));
    EXPECT_TRUE(window.control().noticeText().startsWith("Control of / of agent mixer was lost: "))
        << window.control().noticeText().toStdString();
}

TEST_F(Controlling, StopsWhatIsHeldAtTheFirstPressOfF12) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(comes([] { return live({"call", "/mixer", "startup"}).exit == 0; }));
    ASSERT_TRUE(comes([this] { return isIn("/drive", State::Active); }));
    window.open("/controller");
    ASSERT_TRUE(takes("/controller"));
    window.refresh();
    EXPECT_EQ(window.stopButton().text(), "Stop /controller");
    window.open("/drive");
    EXPECT_EQ(window.stopButton().text(), "Stop /controller") << "it does not follow the selection";
    QTest::keyClick(&window, Qt::Key_F12);
    EXPECT_TRUE(comes([this] { return isIn("/controller", State::Standby); }));
    EXPECT_TRUE(comes([this] {
        return window.stopButton().progress().startsWith("All 1 in Standby, ");
    })) << window.stopButton().progress().toStdString();
    EXPECT_TRUE(isIn("/drive", State::Active));
}

TEST_F(Controlling, AsksBeforeItIsClosed) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(takes("/"));
    const auto answer = [this](const char* text) {
        EXPECT_FALSE(window.close());
        const auto all = window.findChildren<QMessageBox*>();
        const auto found =
            std::ranges::find_if(all, [](const auto* each) { return each->isVisible(); });
        ASSERT_NE(found, all.end());
        QMessageBox* question = *found;
        EXPECT_EQ(question->text(), "Release everything and quit?");
        for (auto* each : question->buttons()) {
            if (each->text() == text) return each->click();
        }
        FAIL() << "no such button";
    };
    answer("Stay");
    EXPECT_TRUE(window.isVisible());
    answer("Quit");
    EXPECT_FALSE(window.isVisible());
}

TEST_F(Controlling, AFormSendsItsCommandAndSaysWhatBecameOfIt) {
    ASSERT_TRUE(everythingComes());
    window.open("/mixer");
    window.refresh();
    CommandCard& startup = card("startup");
    auto* run = startup.findChild<QPushButton*>();
    EXPECT_FALSE(run->isEnabled());
    ASSERT_TRUE(takes("/"));
    window.refresh();
    ASSERT_TRUE(run->isEnabled());
    EXPECT_FALSE(card("takeControl").findChild<QPushButton*>()->isEnabled());
    startup.findChild<ValueField*>()->setText("/drive");
    QTest::keyClick(&startup, Qt::Key_Return, Qt::ControlModifier);
    EXPECT_TRUE(comes([this] { return isIn("/drive", State::Active); }));
    const auto told = [&](const QString& text) {
        const auto labels = startup.findChildren<QLabel*>();
        return std::ranges::any_of(labels,
                                   [&](const auto* each) { return each->text().startsWith(text); });
    };
    EXPECT_TRUE(comes([&] { return told("Done  "); }));
    EXPECT_TRUE(isIn("/controller", State::Standby));
}

TEST_F(Controlling, AFormOfAKilledAgentSaysThatTheCommandMayHaveBeenExecuted) {
    ASSERT_TRUE(everythingComes());
    window.open("/drive");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    agent->end(SIGKILL);
    button("Startup").click();
    EXPECT_TRUE(comes([this] { return says("The command may have been executed."); }));
    EXPECT_TRUE(comes([this] { return says("mixer is not heard"); }));
    EXPECT_TRUE(comes([this] { return !window.control().holds(); }));
}

}  // namespace
}  // namespace cortex::test
