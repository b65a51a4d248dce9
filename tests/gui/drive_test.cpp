// SPDX-License-Identifier: Apache-2.0
// The view of drives on an agent that is made by hand: each state, each button with its reason, and
// what it sends.
#include "drive/drive_views.hpp"
#include "drive/transitions.hpp"
#include "gui/drive_fixture.hpp"
#include "gui/places.hpp"
#include "plugin/plugins.hpp"
#include "style/look.hpp"
#include "views/manual_view.hpp"

#include <QApplication>
#include <QProgressBar>
#include <functional>
#include <memory>
#include <set>
#include <span>

#include <QtTest/QTest>

namespace cortex::test {
namespace {

constexpr std::array allStates{
    Ds402State::Unknown,         Ds402State::NotReadyToSwitchOn,  Ds402State::SwitchOnDisabled,
    Ds402State::ReadyToSwitchOn, Ds402State::SwitchedOn,          Ds402State::OperationEnabled,
    Ds402State::QuickStopActive, Ds402State::FaultReactionActive, Ds402State::Fault};

TEST(ViewsOfDrives, NameTheirSectionOfTheManual) {
    const explorer::Plugin& plugin = explorer::driveViews();
    gui::ManualView manual;
    for (const explorer::ViewType& each : std::span{plugin.views, plugin.count}) {
        const std::unique_ptr<explorer::View> view{each.make("/x")};
        EXPECT_EQ(gui::ManualView::sectionOf(view.get()), "Drives") << each.name;
        EXPECT_TRUE(manual.openAt(gui::ManualView::sectionOf(view.get())));
    }
}

TEST(ViewsOfDrives, AreForTypesThatNobodyKnewToo) {
    gui::Plugins plugins{QStringList{}};
    plugins.add(explorer::driveViews());
    const TypeModel types = driveTypes();
    const auto viewOf = [&](const char* type) {
        const auto* view = plugins.viewFor(*types.find(type), types);
        return std::string{view != nullptr ? view->name : "none"};
    };
    EXPECT_EQ(viewOf("TurntableProcessor"), "drive");
    EXPECT_EQ(viewOf("TurntableDrive"), "link");
    EXPECT_EQ(viewOf("SimulatedAxis"), "none");
}

TEST_F(DriveRig, EachStateIsShownInItsDiagramAndInWords) {
    for (const Ds402State state : allStates) {
        put(1, state);
        show();
        const QString name = explorer::nameOfState(state);
        EXPECT_TRUE(
            band(1).diagram().accessibleDescription().startsWith("The state is " + name + "."))
            << band(1).diagram().accessibleDescription().toStdString();
        const QString said = saidIn(band(1));
        EXPECT_TRUE(said.contains(state == Ds402State::Unknown ? "State unknown" : name))
            << said.toStdString();
    }
}

TEST_F(DriveRig, InEachStateItsTransitionsAreButtonsAndTheOthersSayWhyNot) {
    std::set<int> seen;
    for (const Ds402State state : allStates) {
        put(1, state);
        show();
        for (const int number : explorer::askableTransitions) {
            const auto& rows = drives::ds402Transitions;
            const bool possible = number != 16 && std::ranges::any_of(rows, [&](const auto& row) {
                                      return row.number == number && row.from == state &&
                                             row.command != drives::Ds402Command::None;
                                  });
            EXPECT_EQ(step(1, number).isEnabled(), possible) << number;
            EXPECT_EQ(step(1, number).accessibleDescription().isEmpty(), possible) << number;
            if (possible) seen.insert(number);
        }
    }
    EXPECT_EQ(seen, (std::set{2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15}));
    put(1, Ds402State::ReadyToSwitchOn);
    show();
    EXPECT_EQ(step(1, 4).toolTip(),
              "Transition 4, enable operation, to Operation enabled: needs Switched on");
}

TEST_F(DriveRig, TheWayBackFromAQuickStopDependsOnItsOption) {
    put(2, Ds402State::QuickStopActive);
    show();
    EXPECT_EQ(step(2, 16).accessibleDescription(),
              "needs a quick stop option from 5 to 8; it is 2");
    put("/table/processor", "quickStopOption", 6, 1);
    show();
    EXPECT_EQ(sends(step(2, 16)), "/table/processor step axis=2 word=6");
}

TEST_F(DriveRig, EachTransitionIsAskedForByItsWord) {
    struct Case {
        Ds402State from;
        int number, word;
    };
    for (const Case& each :
         {Case{Ds402State::SwitchOnDisabled, 2, 1}, Case{Ds402State::ReadyToSwitchOn, 3, 2},
          Case{Ds402State::SwitchedOn, 4, 6}, Case{Ds402State::OperationEnabled, 5, 5},
          Case{Ds402State::SwitchedOn, 6, 1}, Case{Ds402State::ReadyToSwitchOn, 7, 3},
          Case{Ds402State::OperationEnabled, 8, 1}, Case{Ds402State::OperationEnabled, 9, 3},
          Case{Ds402State::SwitchedOn, 10, 3}, Case{Ds402State::OperationEnabled, 11, 4},
          Case{Ds402State::QuickStopActive, 12, 3}, Case{Ds402State::Fault, 15, 7}}) {
        put(1, each.from);
        show();
        EXPECT_EQ(sends(step(1, each.number)),
                  "/table/processor step axis=1 word=" + std::to_string(each.word))
            << each.number;
    }
}

TEST_F(DriveRig, TheFourActionsSayInEachStateWhyTheyCannotBePressed) {
    struct Case {
        Ds402State state;
        const char *enable, *disable, *quickStop, *resetFault;
    };
    for (const Case& each :
         {Case{Ds402State::Unknown, "unknown", "not enabled", "", "no fault"},
          Case{Ds402State::NotReadyToSwitchOn, "is not ready", "not enabled", "no power",
               "no fault"},
          Case{Ds402State::SwitchOnDisabled, "", "not enabled", "no power", "no fault"},
          Case{Ds402State::ReadyToSwitchOn, "", "not enabled", "", "no fault"},
          Case{Ds402State::SwitchedOn, "", "not enabled", "", "no fault"},
          Case{Ds402State::OperationEnabled, "is enabled", "", "", "no fault"},
          Case{Ds402State::QuickStopActive, "", "not enabled", "", "no fault"},
          Case{Ds402State::FaultReactionActive, "it brakes", "not enabled", "", "it brakes"},
          Case{Ds402State::Fault, "is in Fault", "not enabled", "is in Fault", ""}}) {
        put(1, each.state);
        show();
        for (const auto& [command, why] : {std::pair{"enable", each.enable},
                                           {"disable", each.disable},
                                           {"quickStop", each.quickStop},
                                           {"resetFault", each.resetFault}}) {
            const QPushButton& button = action(1, command);
            EXPECT_EQ(button.accessibleDescription(), why) << command;
            EXPECT_EQ(button.isEnabled(), std::string{why}.empty()) << command;
            if (*why != '\0')
                EXPECT_TRUE(saidIn(band(1).actions()).contains(why)) << command << ": " << why;
        }
    }
}

TEST_F(DriveRig, AnAxisThatIsLedToItsGoalSaysSo) {
    put(1, Ds402State::ReadyToSwitchOn);
    put("/table/processor", "wanted", 5);
    show();
    EXPECT_TRUE(saidIn(band(1)).contains("Ready to switch on, led to Operation enabled"))
        << saidIn(band(1)).toStdString();
    EXPECT_EQ(action(1, "enable").accessibleDescription(), "is under way");
    EXPECT_EQ(action(1, "disable").accessibleDescription(), "not enabled");
}

TEST_F(DriveRig, EachAxisIsToldByItsOwnButtons) {
    EXPECT_EQ(view.count(), 2);
    EXPECT_EQ(sends(action(1, "disable")), "/table/processor disable axis=1");
    EXPECT_EQ(sends(action(2, "quickStop")), "/table/processor quickStop axis=2");
    EXPECT_EQ(sends(mode(2, 9)), "/table/processor setMode axis=2 mode=9");
    EXPECT_EQ(sends(band(2).homing().homeButton()), "/table/processor home axis=2");
    put(2, Ds402State::SwitchOnDisabled);
    show();
    EXPECT_EQ(sends(action(2, "enable")), "/table/processor enable axis=2");
    put(2, Ds402State::Fault);
    show();
    EXPECT_EQ(sends(action(2, "resetFault")), "/table/processor resetFault axis=2");
}

TEST_F(DriveRig, WhatCameOfAnOrderStandsInItsBand) {
    host.answer = {false, "Rejected (motion): axis 1 turns", {}};
    mode(1, 10).click();
    EXPECT_TRUE(saidIn(band(1)).contains(
        "Mode cyclic synchronous torque (10): Rejected (motion): axis 1 turns"))
        << saidIn(band(1)).toStdString();
    EXPECT_FALSE(saidIn(band(2)).contains("Rejected"));
}

TEST_F(DriveRig, TheModeOfTheDriveIsOnAndOneThatIsAskedForIsSaid) {
    EXPECT_TRUE(mode(1, 8).isChecked());
    put(target(1), "mode", 9);
    show();
    EXPECT_TRUE(mode(1, 8).isChecked());
    EXPECT_FALSE(mode(1, 9).isChecked());
    EXPECT_TRUE(saidIn(band(1)).contains("The drive shows CSP; asked for CSV."))
        << saidIn(band(1)).toStdString();
}

TEST_F(DriveRig, AFaultHasItsCodeAndTheWordsOfTheProcessor) {
    put(2, Ds402State::Fault);
    put(drive(2), "errorCode", 0x8611);
    show();
    EXPECT_TRUE(saidIn(band(2)).contains("Fault 0x8611, following error"))
        << saidIn(band(2)).toStdString();
    put("/table/processor", "errorCode", 0x8611, 1);
    putTexts("/table/processor", "errorText", {"", "0.052 rad, allowed 0.050"});
    show();
    EXPECT_TRUE(saidIn(band(2)).contains("Fault 0x8611, 0.052 rad, allowed 0.050"))
        << saidIn(band(2)).toStdString();
    EXPECT_FALSE(saidIn(band(1)).contains("Fault 0x"));
}

TEST_F(DriveRig, LastTransitionAndRefusedWordsAreCounted) {
    put("/table/processor", "lastTransition", 4, 1);
    put("/table/processor", "transitionCount", 12, 1);
    put("/table/processor", "refusedCount", 3, 1);
    show();
    EXPECT_TRUE(saidIn(band(2)).contains("torque on, last transition 4 of 12, 3 refused"))
        << saidIn(band(2)).toStdString();
}

TEST_F(DriveRig, HomingShowsItsProgressAndIsCancelled) {
    EXPECT_TRUE(saidIn(band(1).homing()).contains("not homed, method 37"));
    EXPECT_FALSE(band(1).homing().cancelButton().isVisibleTo(&band(1)));
    putTexts("/table/processor", "activity", {"home"});
    putTexts("/table/processor", "requester", {"desk.4711"});
    put("/table/processor", "outcome", 2);
    put("/table/processor", "progress", 0.58);
    put(drive(2), "modeDisplay", 6);
    show();
    EXPECT_EQ(saidIn(band(2).homing()), "Homing|58 %|method 37, by desk.4711");
    EXPECT_EQ(band(2).homing().findChild<QProgressBar*>()->value(), 580);
    EXPECT_FALSE(band(1).homing().cancelButton().isVisibleTo(&band(1)));
    EXPECT_EQ(band(1).homing().homeButton().accessibleDescription(), "homing runs");
    EXPECT_EQ(step(2, 5).accessibleDescription(), "homing runs");
    EXPECT_FALSE(mode(2, 8).isEnabled());
    EXPECT_EQ(action(2, "disable").accessibleDescription(), "homing runs");
    EXPECT_TRUE(action(2, "quickStop").isEnabled());
    EXPECT_TRUE(step(1, 5).isEnabled());
    controls = false;  // an end needs none
    show();
    EXPECT_EQ(sends(band(2).homing().cancelButton()), "/table/processor cancel");
    put("/table/processor", "outcome", 5);
    put(drive(2), "modeDisplay", 8);
    show();
    EXPECT_TRUE(saidIn(band(2).homing()).contains("the last one: Cancelled (5)"))
        << saidIn(band(2).homing()).toStdString();
}

TEST_F(DriveRig, AnAxisThatIsHomedAndOneThatNeedsNoneAreTold) {
    put(drive(1), "homed", 1);
    show();
    EXPECT_TRUE(saidIn(band(1).homing()).contains("|homed, method 37"))
        << saidIn(band(1).homing()).toStdString();
    put(1, Ds402State::SwitchedOn);
    show();
    EXPECT_EQ(band(1).homing().homeButton().accessibleDescription(), "needs Operation enabled");
}

TEST_F(DriveRig, WithoutControlOrInAnotherStateOfTheProcessorAllButAStopIsOffAndSaysWhy) {
    controls = false;
    show();
    const QString why = "read-only: take control of /table";
    for (const char* command : {"enable", "disable", "resetFault"})
        EXPECT_EQ(action(1, command).accessibleDescription(), why) << command;
    EXPECT_TRUE(action(1, "quickStop").isEnabled());
    EXPECT_EQ(step(1, 5).accessibleDescription(), why);
    EXPECT_EQ(mode(1, 9).toolTip(), why);
    EXPECT_TRUE(saidIn(band(1)).contains("|" + why + ".")) << saidIn(band(1)).toStdString();
    controls = true;
    put("/table/processor", "state", 0);
    show();
    EXPECT_EQ(action(1, "enable").accessibleDescription(), "needs Active");
    EXPECT_TRUE(action(1, "disable").isEnabled());
    EXPECT_TRUE(step(1, 5).isEnabled());
    put(1, Ds402State::SwitchedOn);
    show();
    EXPECT_EQ(step(1, 4).accessibleDescription(), "needs Active");
    EXPECT_TRUE(step(1, 6).isEnabled());
}

TEST_F(DriveRig, ADriveThatIsLostIsShownAsItWasAndOnlyAQuickStopIsLeft) {
    robot.degrade(drive(1), Quality::Lost);
    put("/table/drive", "exchangeCount", 1);  // it has answered once
    put("/table/drive", "link", 1);
    show();
    const QString said = saidIn(band(1));
    EXPECT_TRUE(said.contains("[Operation enabled]")) << said.toStdString();
    EXPECT_TRUE(said.contains("the link of /table/drive is not open.")) << said.toStdString();
    EXPECT_TRUE(said.contains("The drive shows [cyclic synchronous position (8)]"));
    EXPECT_TRUE(band(1).diagram().accessibleDescription().startsWith(
        "The last known state is Operation enabled."));
    EXPECT_EQ(step(1, 5).accessibleDescription(), "the link of /table/drive is not open");
    EXPECT_FALSE(action(1, "disable").isEnabled());
    EXPECT_FALSE(mode(1, 8).isChecked());
    EXPECT_TRUE(action(1, "quickStop").isEnabled());
    EXPECT_TRUE(action(2, "disable").isEnabled());
    put("/table/drive", "link", 2);
    show();
    EXPECT_TRUE(saidIn(band(1)).contains("/table/drive/a is lost."));
}

TEST_F(DriveRig, OfALostAgentNothingCanBeToldAndNothingLooksLive) {
    show("lost");
    for (const int axis : {1, 2}) {
        const QString said = saidIn(band(axis));
        EXPECT_TRUE(said.contains("[Operation enabled]")) << said.toStdString();
        for (auto* each : band(axis).findChildren<QPushButton*>())
            EXPECT_FALSE(each->isEnabled()) << each->text().toStdString();
    }
    EXPECT_EQ(action(1, "quickStop").accessibleDescription(), "robot is not heard");
    EXPECT_TRUE(saidIn(view).contains("[Link open]")) << saidIn(view).toStdString();
}

TEST_F(DriveRig, PathsOpenWhatIsRelated) {
    std::vector<std::string> opened;
    QObject::connect(&view, &explorer::View::opened,
                     [&](const std::string& path) { opened.push_back(path); });
    for (auto* each : view.findChildren<QAbstractButton*>()) {
        if (each->text().startsWith('/')) each->click();
    }
    std::ranges::sort(opened);
    EXPECT_EQ(opened, (std::vector<std::string>{"/table/demand/a", "/table/demand/b",
                                                "/table/drive", "/table/drive/a", "/table/drive/b",
                                                "/table/set/a", "/table/set/b"}));
}

TEST_F(DriveRig, WhereThereIsLittleRoomOneAxisIsShownAndTheOtherIsChosen) {
    EXPECT_TRUE(band(1).isVisible() && band(2).isVisible());
    view.resize(700, 400);
    put(2, Ds402State::Fault);
    show();
    EXPECT_TRUE(band(1).isVisible());
    EXPECT_FALSE(band(2).isVisible());
    for (auto* each : view.findChildren<QPushButton*>()) {
        if (each->text() == "Axis 2: Fault") each->click();
    }
    EXPECT_FALSE(band(1).isVisible());
    EXPECT_TRUE(band(2).isVisible());
}

TEST_F(DriveRig, AllIsDoneByKeysAndWhatHasThemIsScrolledTo) {
    view.resize(975, 300);
    QApplication::setActiveWindow(&view);
    QPushButton& last = band(2).homing().homeButton();
    last.setFocus();
    QApplication::processEvents();
    EXPECT_FALSE(last.visibleRegion().isEmpty());
    QTest::keyClick(&last, Qt::Key_Space);
    EXPECT_EQ(sent(), "/table/processor home axis=2");
    step(1, 11).setFocus();
    QApplication::processEvents();
    EXPECT_FALSE(step(1, 11).visibleRegion().isEmpty());
    QTest::keyClick(&step(1, 11), Qt::Key_Space);
    EXPECT_EQ(sent(), "/table/processor step axis=1 word=4");
    for (auto* each : view.findChildren<QAbstractButton*>())
        EXPECT_TRUE((each->focusPolicy() & Qt::TabFocus) != 0 &&
                    !(each->accessibleName() + each->text()).isEmpty());
}

// All that can be said of an axis and its link, each after the other.
class SteadyDrives : public DriveRig {
protected:
    ~SteadyDrives() override {
        gui::Look::apply(gui::Theme::Light, 1, QStringLiteral("Open Sans"));
    }
    std::vector<std::function<void()>> whatComes() {
        const std::string processor = "/table/processor";
        std::vector<std::function<void()>> all;
        for (const Ds402State state : allStates) all.push_back([=, this] { put(1, state); });
        all.push_back([=, this] {
            put(processor, "errorCode", 0x8611);
            putTexts(processor, "errorText", {"following error of 0.052 rad, allowed 0.050", ""});
        });
        all.push_back([=, this] { put(processor, "transitionCount", 123456); });
        all.push_back([=, this] { put(target(1), "mode", 9); });
        all.push_back([=, this] {
            put(1, Ds402State::OperationEnabled);
            putTexts(processor, "activity", {"home"});
            putTexts(processor, "requester", {"cortex-explorer@desk.4711"});
            put(processor, "outcome", 2);
            put(drive(1), "modeDisplay", 6);
        });
        all.push_back([=, this] { put(processor, "outcome", 5); });
        all.push_back([this] { put("/table/drive", "exchangeTimeP99", 1234567); });
        all.push_back([this] { put("/table/drive", "link", 1); });
        all.push_back([this] { robot.degrade(drive(1), Quality::Lost); });
        all.push_back([this] { controls = false; });
        all.push_back([this] { view.band(0).say(QString{"Rejected "}.repeated(30)); });
        return all;
    }
};

TEST_F(SteadyDrives, NothingMovesWhateverComes) {
    struct Size {
        int width, height;
        double scale;
        const char* family;
    };
    for (const Size& at : {Size{975, 570, 1, "Open Sans"}, Size{975, 570, 1, "DejaVu Sans"},
                           Size{800, 350, 1, "Open Sans"}, Size{800, 250, 1.5, "DejaVu Sans"}}) {
        gui::Look::apply(gui::Theme::Light, at.scale, QLatin1String{at.family});
        view.resize(at.width, at.height);
        robot.degrade(drive(1), Quality::Good);
        controls = true;
        // Fonts reach all parts in any order, and what they make of the rows is there one frame
        // later.
        for (int frame = 0; frame < 2; ++frame) show();
        const Places before = placesIn(view);
        ASSERT_GE(before.size(), 15U);
        const auto all = whatComes();
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i]();
            show();
            EXPECT_EQ(movedSince(before, view), "") << at.width << ", " << at.family << ", " << i;
        }
    }
}

class OneDrive : public testing::Test {
protected:
    // `drives`: what the processor names.
    QString saidOf(const std::function<void(SimplexTree&, Simplex&)>& relate) {
        MadeAgent robot{
            "robot",
            [&](SimplexTree& tree) { relate(tree, tree.add("/processor", "TurntableProcessor")); },
            driveTypes()};
        host.frame = frameOf({robot.now()});
        DriveView view{"/processor"};
        view.setHost(&host);
        const explorer::SystemNow now{*host.frame};
        view.bind(now);
        view.refresh(now);
        QStringList all;
        for (const auto* each : view.band(0).findChildren<QLabel*>()) all << each->text();
        return QString::number(view.count()) + " " + all.join('|');
    }
    RecordingHost host;
};

TEST_F(OneDrive, ThatIsMissingIsSaid) {
    const QString said = saidOf([](SimplexTree&, Simplex&) {});
    EXPECT_TRUE(said.startsWith("1 Axis 1|")) << said.toStdString();
    EXPECT_TRUE(said.contains("no drive is related|no set-point is related|no demand is related"))
        << said.toStdString();
    EXPECT_TRUE(said.contains("no drive is related to this axis.")) << said.toStdString();
}

TEST_F(OneDrive, OfAnAgentThatIsNotHeardIsSaid) {
    const QString said = saidOf([](SimplexTree& tree, Simplex& processor) {
        tree.relateRemote(processor, "drives", "/far/drive");
    });
    EXPECT_TRUE(said.contains("/far/drive is not heard.")) << said.toStdString();
    EXPECT_TRUE(said.contains("[State unknown]")) << said.toStdString();
}

}  // namespace
}  // namespace cortex::test
