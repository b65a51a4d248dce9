// SPDX-License-Identifier: Apache-2.0
// Two axes of a simulated CiA 402 drive in an agent of its own, led through homing, fault, reset
// and motion by the buttons of the window alone.
#include "drive/action_row.hpp"
#include "drive/axis_band.hpp"
#include "drive/drive_view.hpp"
#include "drive/homing_row.hpp"
#include "drive/state_diagram.hpp"
#include "gui/audit.hpp"
#include "gui/motion_fixture.hpp"
#include "motion/choices.hpp"
#include "views/event_list.hpp"
#include "views/life_cycle_bar.hpp"
#include "window/arrangement.hpp"

namespace cortex::test {
namespace {

using explorer::AxisBand;
using explorer::DriveView;

const char* const tableTypes = R"(<ontology name="plant" version="1.0"><include file="drives.xml"/>
  <type name="TableDemand" extends="RotaryAxisModification" role="modification" version="1.0"
        description="How an axis of the turntable is wished to be.">
    <data name="position" min="-3" max="3" rate="1"/>
    <data name="velocity" min="-1" max="1" rate="20"/>
    <data name="acceleration" min="-20" max="20" rate="400"/>
  </type></ontology>)";

// The second axis looks for a switch, which takes long at this speed.
std::string tableSystem() {
    std::string simplexes, drive, processor, jog;
    const auto relate = [](const char* rule, const std::string& to) {
        return "<relate rule=\"" + std::string{rule} + "\" to=\"" + to + "\"/>";
    };
    for (const std::string axis : {"a", "b"}) {
        const std::string says = "/table/drive/" + axis, told = "/table/set/" + axis,
                          wished = "/table/demand/" + axis;
        for (const auto& [path, type] : {std::pair{says, "Ds402RotaryObservation"},
                                         {told, "Ds402RotaryModification"},
                                         {wished, "TableDemand"}})
            simplexes += "<simplex path=\"" + path + "\" type=\"" + type + "\"/>";
        drive += relate("demands", told) + relate("observations", says);
        processor += relate("drives", says) + relate("demands", wished) + relate("setpoints", told);
        jog += relate("axes", says) + relate("demands", wished);
    }
    return "<system name=\"robot\"><ontology file=\"plant.xml\"/>"
           "<morphology file=\"cortex-morphology.xml\"/>" +
           simplexes + "<simplex path=\"/table/drive\" type=\"Ds402SimulatedDrive\">" + drive +
           "</simplex><simplex path=\"/table/processor\" type=\"Ds402AxisProcessor\">" + processor +
           R"(<set data="homingMethod" value="37 17"/><set data="homingSpeed" value="0.01 0.01"/>)"
           "</simplex><simplex path=\"/jog\" type=\"JogController\">" +
           jog +
           R"(</simplex><cluster name="robot" frequency="500" overflow="skip" control="open"/></system>)";
}

class DrivesInAWindow : public MotionWindow {
protected:
    DrivesInAWindow() : MotionWindow{tableTypes, tableSystem()} { axes = 2; }

    void goTo(const std::string& path) {
        window.open(path);
        ASSERT_TRUE(
            comes([&] { return number(path, "state") >= 0 && lifeCycle("Startup") != nullptr; }));
    }
    QPushButton* lifeCycle(const QString& text) {
        const auto* bar = window.current()->findChild<gui::LifeCycleBar*>();
        if (bar == nullptr) return nullptr;
        for (auto* each : bar->findChildren<QPushButton*>()) {
            if (each->text() == text) return each;
        }
        return nullptr;
    }
    // Waits until it can be pressed, and presses it.
    bool presses(const std::function<QPushButton*()>& button) {
        if (!comes([&] { return button() != nullptr && button()->isEnabled(); })) return false;
        button()->click();
        return true;
    }
    bool startsBy(const std::string& path) {
        return presses([this] { return lifeCycle("Startup"); }) &&
               comes([&] { return number(path, "state") == 2; });
    }
    AxisBand& band(int axis) { return window.current()->findChild<DriveView*>()->band(axis - 1); }
    bool says(int axis, const QString& text) {
        return comes([&] {
            for (const auto* each : band(axis).findChildren<QLabel*>()) {
                if (each->text().contains(text)) return true;
            }
            return false;
        });
    }
    bool acts(int axis, const char* command) {
        return presses([=, this] { return &band(axis).actions().button(command); });
    }
    void opensProcessor() {
        ASSERT_TRUE(comes([this] { return window.ready(); }));
        window.open("/table/drive");
        ASSERT_TRUE(takes("/"));
        QApplication::setActiveWindow(&window);
        ASSERT_NO_FATAL_FAILURE(goTo("/table/drive"));
        ASSERT_TRUE(startsBy("/table/drive"));
        ASSERT_NO_FATAL_FAILURE(goTo("/table/processor"));
        ASSERT_TRUE(startsBy("/table/processor"));
        ASSERT_TRUE(says(1, "Operation enabled") && says(2, "Operation enabled"));
    }
    // The header takes less room, and the strip of events none until somebody wants it.
    void haveRoomAndCanBeRead() {
        const auto strip = [this] { return window.findChild<gui::EventList*>()->isVisible(); };
        const auto settles = [this] {
            for (int i = 0; i < 4; ++i) {
                window.refresh();
                QApplication::processEvents();  // what is laid out lays out more
            }
        };
        for (const QSize size : {QSize{1280, 800}, QSize{800, 600}}) {
            window.resize(size);
            settles();
            EXPECT_FALSE(strip());
            const QStringList found = unreadableIn(window);
            EXPECT_TRUE(found.isEmpty()) << size.width() << ": " << found.join("\n").toStdString();
        }
        window.resize(1280, 800);
        settles();
        for (const int axis : {1, 2}) {
            for (auto* each : band(axis).findChildren<QPushButton*>()) {
                if (each->isVisible())
                    EXPECT_EQ(each->visibleRegion().boundingRect().size(), each->size())
                        << axis << ": " << each->text().toStdString();
            }
        }
        window.arrangement().toggleEvents(window.workspace());
        EXPECT_TRUE(strip());
        window.open("/jog");
        settles();
        EXPECT_TRUE(strip());
    }
};

TEST_F(DrivesInAWindow, AreHomedResetAfterAFaultAndMovedByButtonsAlone) {
    ASSERT_NO_FATAL_FAILURE(opensProcessor());
    const auto home = [this] { return &band(1).homing().homeButton(); };
    ASSERT_TRUE(presses(home));
    EXPECT_TRUE(says(1, "Home: Done"));
    EXPECT_TRUE(says(1, "homed, method 37"));

    session.send("/table/drive", "injectFault",
                 {{"axis", std::int64_t{1}}, {"code", std::int64_t{0x2310}}});
    EXPECT_TRUE(says(1, "Fault: over-current (0x2310)"));
    ASSERT_TRUE(acts(1, "resetFault"));
    EXPECT_TRUE(says(1, "Reset fault: Done"));
    EXPECT_TRUE(says(1, "Switch on disabled"));
    ASSERT_TRUE(presses([this] { return lifeCycle("Clear faults"); }));
    ASSERT_TRUE(startsBy("/table/processor"));
    EXPECT_TRUE(says(1, "Operation enabled"));

    ASSERT_NO_FATAL_FAILURE(goTo("/jog"));
    ASSERT_TRUE(startsBy("/jog"));
    ASSERT_TRUE(comes([this] {
        const auto* view = window.current()->findChild<AxisRows*>();
        return view != nullptr && view->count() == 2 && button(0, 1).isEnabled();
    })) << said().toStdString();
    QTest::mousePress(&button(0, 1), Qt::LeftButton);
    EXPECT_TRUE(moves([this] { QTest::mouseRelease(&button(0, 1), Qt::LeftButton); },
                      [this] { QTest::mousePress(&button(0, 1), Qt::LeftButton); },
                      [this] { return number("/table/drive/a", "position") > 0.01; }))
        << said().toStdString();
    QTest::mouseRelease(&button(0, 1), Qt::LeftButton);
}

TEST_F(DrivesInAWindow, HaveRoomAndAreCancelledSteppedAndSwitchedToAnotherModeByButtons) {
    ASSERT_NO_FATAL_FAILURE(opensProcessor());
    haveRoomAndCanBeRead();
    ASSERT_NO_FATAL_FAILURE(goTo("/table/processor"));
    ASSERT_TRUE(presses([this] { return &band(2).homing().homeButton(); }));
    EXPECT_TRUE(says(2, "method 17, by "));
    EXPECT_TRUE(says(2, "The drive shows homing (6)"));
    EXPECT_FALSE(band(1).homing().homeButton().isEnabled());
    ASSERT_TRUE(presses([this] { return &band(2).homing().cancelButton(); }));
    EXPECT_TRUE(says(2, "the last one: Cancelled"));

    ASSERT_TRUE(presses([this] { return band(1).modes().button("9"); }));
    EXPECT_TRUE(says(1, "The drive shows cyclic synchronous velocity (9)."));
    ASSERT_TRUE(presses([this] { return &band(1).diagram().button(5); }));
    EXPECT_TRUE(says(1, "Switched on"));
    ASSERT_TRUE(presses([this] { return &band(1).diagram().button(6); }));
    EXPECT_TRUE(says(1, "Ready to switch on"));
    ASSERT_TRUE(acts(1, "enable"));
    EXPECT_TRUE(says(1, "Operation enabled"));
    ASSERT_TRUE(acts(1, "quickStop"));
    EXPECT_TRUE(says(1, "Switch on disabled"));
}

}  // namespace
}  // namespace cortex::test
