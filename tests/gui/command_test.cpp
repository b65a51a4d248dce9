// SPDX-License-Identifier: Apache-2.0
// What became of a command stays with its simplex, with a real agent over DDS.
#include "gui/places.hpp"
#include "gui/window_fixture.hpp"
#include "style/look.hpp"
#include "views/command_card.hpp"
#include "views/command_list.hpp"
#include "views/edit_bar.hpp"
#include "views/life_cycle_bar.hpp"
#include "widgets/popover.hpp"
#include "widgets/text_label.hpp"
#include "widgets/value_field.hpp"
#include "window/control_bar.hpp"

#include <QLabel>
#include <QPushButton>
#include <QScrollBar>

namespace cortex::test {
namespace {

// A move of minutes.
const std::string longWay = "pose=1e5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";

class Commanding : public Window {
protected:
    Commanding() : Window{"AxisPoseController"} {}

    bool takes(const std::string& prefix) {
        session.takeControl(prefix);
        return comes([&] { return window.control().prefix() == prefix; });
    }
    void shows(const std::string& path, const char* part) {
        window.open(path);
        window.openPart(part);
        window.refresh();
    }
    CommandCard& card(const std::string& command) {
        for (auto* each : window.current()->findChildren<CommandCard*>()) {
            if (each->command().name == command) return *each;
        }
        throw std::runtime_error{"no such command"};
    }
    static QPushButton& button(const QWidget& below, const QString& text) {
        for (auto* each : below.findChildren<QPushButton*>()) {
            if (each->text() == text) return *each;
        }
        throw std::runtime_error{"no such button"};
    }
    static bool says(const QWidget& widget, const QString& text) {
        const auto labels = widget.findChildren<QLabel*>();
        return std::ranges::any_of(labels, [&](const auto* each) {
            return !each->isHidden() && each->text().contains(text);
        });
    }
    bool movesForLong() {
        EXPECT_EQ(live({"call", "/mixer", "startup"}).exit, 0);
        EXPECT_EQ(live({"set", "/controller", longWay}).exit, 0);
        const auto moveTo = std::vector<std::string>{CORTEX_BINARY_DIR "/bin/cortex",
                                                     "call",
                                                     "/controller",
                                                     "moveTo",
                                                     "speedShare=0.01",
                                                     "--timeout",
                                                     "100"} +
                            network;
        shows("/controller", "commands");
        return comes([&] {  // called again, where the agent was silent for a second
            if (!other || !other->runs()) other.emplace(moveTo, false);
            return button(card("moveTo"), "Cancel").isVisible();
        });
    }
    // Some frames after this one.
    bool goesOn() {
        const std::uint64_t now = session.frame()->number;
        return comes([&] {
            window.refresh();
            return session.frame()->number > now + 5;
        });
    }

    std::optional<Background> other;
};

TEST_F(Commanding, AFormThatComesBackShowsWhatBecameOfItsCommand) {
    ASSERT_TRUE(everythingComes());
    shows("/drive", "commands");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    card("startup").run();
    ASSERT_TRUE(comes([this] { return says(card("startup"), "Done  "); }));
    shows("/controller", "commands");
    EXPECT_FALSE(says(card("startup"), "Done  ")) << "that was another simplex";
    shows("/drive", "commands");
    EXPECT_TRUE(says(card("startup"), "Done  "));
}

TEST_F(Commanding, AFormThatComesBackHasWhatWasTypedAndIsScrolledAsItWas) {
    ASSERT_TRUE(everythingComes());
    shows("/controller", "commands");
    const auto field = [this] { return card("moveTo").findChild<ValueField*>(); };
    const auto bar = [this] {
        return window.current()->findChild<CommandList*>()->verticalScrollBar();
    };
    field()->setText("0.25");
    QApplication::processEvents();
    ASSERT_GT(bar()->maximum(), 20);
    bar()->setValue(20);
    shows("/drive", "commands");
    shows("/controller", "commands");
    EXPECT_EQ(field()->text(), "0.25");
    QApplication::processEvents();
    EXPECT_EQ(bar()->value(), 20);
    field()->setText({});
    shows("/drive", "commands");
    shows("/controller", "commands");
    EXPECT_TRUE(field()->isEmpty()) << "what was taken away does not come back";
}

TEST_F(Commanding, ThatACommandMayHaveBeenExecutedIsNotLostByLookingAtSomethingElse) {
    ASSERT_TRUE(everythingComes());
    shows("/drive", "commands");
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    agent->send(SIGSTOP);
    button(*window.current()->findChild<LifeCycleBar*>(), "Startup").click();
    shows("/controller", "commands");
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    ASSERT_TRUE(goesOn());
    EXPECT_FALSE(says(*window.current(), "may have been executed"));
    shows("/drive", "commands");
    EXPECT_TRUE(says(*window.current(), "Startup: No answer came."));
    EXPECT_TRUE(says(card("startup"), "The command may have been executed."));
}

TEST_F(Commanding, CancelNeedsNoControlAndItsAnswerIsShown) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(movesForLong());
    ASSERT_FALSE(window.control().holds());
    QPushButton& cancel = button(card("moveTo"), "Cancel");
    ASSERT_TRUE(cancel.isEnabled()) << "agents let everybody cancel, as they let everybody stop";
    cancel.click();
    EXPECT_TRUE(comes([this] { return says(card("moveTo"), "Cancel: Done  "); }));
    EXPECT_TRUE(comes([&] { return !cancel.isVisible(); }));
}

TEST_F(Commanding, CancelSaysWhyItIsOff) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(movesForLong());
    agent->send(SIGSTOP);
    EXPECT_TRUE(comes([this] { return says(card("moveTo"), "mixer is not heard"); }));
    EXPECT_TRUE(button(card("moveTo"), "Cancel").isVisible());
    EXPECT_FALSE(button(card("moveTo"), "Cancel").isEnabled());
    agent->send(SIGCONT);
    EXPECT_TRUE(comes([this] { return button(card("moveTo"), "Cancel").isEnabled(); }));
}

class SteadyCards : public Commanding {
protected:
    ~SteadyCards() override { Look::apply(Theme::Light, 1, QStringLiteral("Open Sans")); }
    void showSmall() {
        Look::apply(Theme::Light, 1.5, QStringLiteral("DejaVu Sans"));
        window.resize(800, 600);
    }
    QWidget& page() {
        window.refresh();
        return *window.current()->findChild<CommandList*>();
    }
};

TEST_F(SteadyCards, NothingMovesWhenACommandIsAnswered) {
    window.resize(1280, 800);
    ASSERT_TRUE(everythingComes());
    for (const char* command : {"startup", "shutdown"}) {
        shows("/drive", "commands");
        ASSERT_TRUE(takes("/drive"));
        const Places before = placesIn(page());
        ASSERT_GE(before.size(), 4U);
        card(command).run();
        EXPECT_EQ(movedSince(before, page()), "") << command << " is under way";
        ASSERT_TRUE(comes([&] { return says(card(command), "Done  "); }));
        EXPECT_EQ(movedSince(before, page()), "") << command;
        session.releaseControl();
        ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
        EXPECT_EQ(movedSince(before, page()), "") << "control is lost";
        showSmall();
    }
}

TEST_F(SteadyCards, NothingMovesWhileALongCommandRunsAndWhenItIsCancelledOrAFieldIsWrong) {
    showSmall();
    ASSERT_TRUE(everythingComes());
    shows("/controller", "commands");
    const Places before = placesIn(page());
    card("moveTo").findChild<ValueField*>()->setText("too fast");
    EXPECT_TRUE(says(card("moveTo"), "speedShare: number expected")) << shownTexts();
    EXPECT_EQ(movedSince(before, page()), "") << "what is wrong with a field";
    ASSERT_TRUE(movesForLong());
    EXPECT_EQ(movedSince(before, page()), "");
    const Places running = placesIn(page());
    button(card("moveTo"), "Cancel").click();
    EXPECT_EQ(movedSince(running, page()), "") << "cancel is under way";
    ASSERT_TRUE(comes([this] { return says(card("moveTo"), "Cancel: Done  "); }));
    ASSERT_TRUE(comes([this] { return !button(card("moveTo"), "Cancel").isVisible(); }));
    EXPECT_EQ(movedSince(running, page()), "");
}

TEST_F(SteadyCards, AnAnswerThatHasNoRoomIsWholeInItsTooltipAndWhereItIsOpened) {
    showSmall();
    ASSERT_TRUE(everythingComes());
    shows("/drive", "commands");
    ASSERT_TRUE(takes("/drive"));
    const Places before = placesIn(page());
    agent->send(SIGSTOP);
    card("startup").run();
    const QString whole = "Look at the state before you send it again.";
    ASSERT_TRUE(comes([&] { return says(card("startup"), whole); }));
    EXPECT_EQ(movedSince(before, page()), "");
    const auto labels = card("startup").findChildren<TextLabel*>();
    EXPECT_TRUE(std::ranges::any_of(labels, [&](const auto* each) {
        return each->toolTip().replace('\n', ' ').contains(whole);
    }));
    button(card("startup"), "Whole answer…").click();
    auto* popover = card("startup").findChild<Popover*>();
    ASSERT_NE(popover, nullptr);
    const auto texts = popover->findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(texts, [&](const auto* each) {
        return each->text().contains(whole) &&
               each->textInteractionFlags().testFlag(Qt::TextSelectableByMouse);
    }));
    EXPECT_EQ(movedSince(before, page()), "");
    popover->close();
}

class Undoing : public Commanding {
protected:
    bool sets() {
        shows("/drive", "data");
        if (!takes("/drive")) return false;
        if (!comes([this] { return valueOf("dampingRatio") == "0.9"; })) return false;
        auto& items = *window.current()->findChild<ItemTable*>()->model();
        for (int group = 0; group < items.rowCount(); ++group) {
            const QModelIndex above = items.index(group, 0);
            for (int row = 0; row < items.rowCount(above); ++row) {
                if (items.index(row, ItemModel::Name, above).data() != "dampingRatio") continue;
                items.setData(items.index(row, ItemModel::Value, above), "0.75");
            }
        }
        window.refresh();
        bar().submit();
        return comes([this] { return says(bar(), "Set: dampingRatio 0.9 → 0.75"); }) &&
               comes([this] { return valueOf("dampingRatio") == "0.75"; });
    }
    EditBar& bar() { return *window.current()->findChild<EditBar*>(); }
    static std::string ofTheAgent() { return live({"show", "/drive"}).output; }
};

TEST_F(Undoing, SendsNothingWithoutControlAndCanStillBeDoneWithIt) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(sets());
    session.releaseControl();
    ASSERT_TRUE(comes([this] { return !window.control().holds(); }));
    window.refresh();
    bar().undo();
    EXPECT_TRUE(says(bar(), "Not undone: read-only: take control of /drive"));
    ASSERT_TRUE(goesOn());
    EXPECT_NE(ofTheAgent().find("0.75"), std::string::npos);
    ASSERT_TRUE(takes("/drive"));
    window.refresh();
    bar().undo();
    EXPECT_TRUE(comes([this] { return says(bar(), "Undone: dampingRatio 0.75 → 0.9"); }));
}

TEST_F(Undoing, SetsNothingThatIsNotShown) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(sets());
    shows("/controller", "data");
    EXPECT_FALSE(says(*window.current(), "Set: dampingRatio"));
    bar().undo();
    ASSERT_TRUE(goesOn());
    EXPECT_NE(ofTheAgent().find("0.75"), std::string::npos);
    shows("/drive", "data");
    EXPECT_TRUE(says(bar(), "Set: dampingRatio 0.9 → 0.75"));
    bar().undo();
    EXPECT_TRUE(comes([this] { return says(bar(), "Undone: dampingRatio 0.75 → 0.9"); }));
}

TEST_F(Undoing, AnAnswerThatComesWhileSomethingElseIsShownStaysWithItsSimplex) {
    ASSERT_TRUE(everythingComes());
    ASSERT_TRUE(sets());
    agent->send(SIGSTOP);
    bar().undo();
    shows("/controller", "data");
    ASSERT_TRUE(comes([this] { return session.frame()->agents.front().lost(); }));
    ASSERT_TRUE(goesOn());
    EXPECT_FALSE(says(*window.current(), "may have been executed"));
    shows("/drive", "data");
    EXPECT_TRUE(says(bar(), "The command may have been executed."));
}

}  // namespace
}  // namespace cortex::test
