// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/live_agent.hpp"
#include "gui/taking.hpp"
#include "gui/window_fixture.hpp"
#include "motion/axis_rows.hpp"
#include "motion/axis_view.hpp"
#include "motion/labels.hpp"
#include "motion/motion_bar.hpp"
#include "window/control_bar.hpp"

#include <QApplication>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <QtTest/QTest>

namespace cortex::test {

using explorer::AxisRow;
using explorer::AxisRows;
using explorer::AxisView;
using explorer::MotionBar;

// A turning axis with a stop near, a sliding one, and one whose type states no speed, each with its
// drive; a controller that jogs them, and one that brings them to a pose.
inline const char* const motionTypes = R"(<ontology name="plant" version="1.0">
  <include file="robotics.xml"/>
  <type name="Turn" extends="RotaryAxisConcept" version="1.0" description="An axis that turns either way.">
    <data name="position" min="-2.6" max="2.6" rate="1"/>
    <data name="velocity" min="-1" max="1" rate="20"/>
    <data name="acceleration" min="-20" max="20" rate="400"/>
  </type>
  <type name="Slide" extends="LinearAxisConcept" version="1.0" description="An axis that slides along a rail.">
    <data name="position" min="-0.01" max="0.05" rate="0.25"/>
    <data name="velocity" min="-0.25" max="0.25" rate="5"/>
    <data name="acceleration" min="-5" max="5" rate="100"/>
  </type>
  <type name="Unstated" extends="RotaryAxisConcept" version="1.0" description="An axis without a stated speed.">
    <data name="position" min="-1" max="1"/>
  </type>
</ontology>)";

// `hold`: that of the controller that jogs; "": as its type has it.
inline std::string motionSystem(const std::string& hold = longHold) {
    std::string text =
        "<system name=\"robot\"><ontology file=\"plant.xml\"/>"
        "<morphology file=\"cortex-morphology.xml\"/>";
    const std::vector<std::pair<std::string, std::string>> axes{
        {"1", "Turn"}, {"2", "Slide"}, {"3", "Unstated"}};
    for (const auto& [name, type] : axes) {
        for (const char* kind : {"axes", "demands"})
            text += "<simplex path=\"/arm/" + std::string{kind} + "/" + name + "\" type=\"" + type +
                    "\"/>";
        text += "<simplex path=\"/drives/" + name +
                "\" type=\"SimulatedAxis\"><relate "
                "rule=\"demand\" to=\"/arm/demands/" +
                name +
                "\"/><relate rule=\"observation\" "
                "to=\"/arm/axes/" +
                name + "\"/></simplex>";
    }
    const std::vector<std::array<std::string, 3>> controllers{{"/jog", "JogController", hold},
                                                              {"/pose", "AxisPoseController", ""}};
    for (const auto& [path, type, items] : controllers) {
        text += "<simplex path=\"" + path + "\" type=\"" + type + "\">" + items;
        for (const auto& axis : axes) {
            text += "<relate rule=\"axes\" to=\"/arm/axes/" + axis.first + "\"/>" +
                    "<relate rule=\"demands\" to=\"/arm/demands/" + axis.first + "\"/>";
        }
        text += "</simplex>";
    }
    return text +
           R"(<cluster name="robot" frequency="500" overflow="skip" control="open"/></system>)";
}

class MotionAgent : public testing::Test {
protected:
    explicit MotionAgent(const std::string& types = motionTypes,
                         const std::string& system = motionSystem()) {
        folder.write("plant.xml", types);
        agent.emplace(agentCommand(folder.write("robot.xml", system).string()));
    }
    bool starts(const std::string& controller) const {
        std::vector<std::string> paths;
        for (int i = 1; i <= axes; ++i) paths.push_back("/drives/" + std::to_string(i));
        paths.push_back(controller);
        for (const std::string& path : paths) {
            // Again, where the agent was silent for a second.
            const Outcome started =
                lookUntil([&] { return live({"call", path, "startup"}); },
                          [](const Outcome& seen) { return !contains(seen.output, "not heard"); });
            EXPECT_EQ(started.exit, 0) << path << ": " << started.output << started.errors;
            if (started.exit != 0) return false;
        }
        return true;
    }

    int axes = 3;
    const ModelFolder folder;
    std::optional<Background> agent;
};

class MotionWindow : public MotionAgent {
protected:
    explicit MotionWindow(const std::string& types = motionTypes,
                          const std::string& system = motionSystem())
        : MotionAgent{types, system}, session{ownNetwork()}, window{session} {
        window.resize(1280, 800);
        window.show();
    }
    bool takes(const std::string& prefix) { return takesControl(window, session, prefix); }
    // The view of this controller, which is Active.
    void opens(const std::string& controller) {
        ASSERT_TRUE(comes([this] { return window.ready(); }));
        ASSERT_TRUE(starts(controller));
        window.open(controller);
        ASSERT_TRUE(comes([&] {
            auto* rows = window.current()->findChild<AxisRows*>();
            return rows != nullptr && rows->count() == axes && number(controller, "state") == 2;
        }));
    }
    void opensInControl(const std::string& controller) {
        ASSERT_NO_FATAL_FAILURE(opens(controller));
        ASSERT_TRUE(takes("/"));
        QApplication::setActiveWindow(&window);
        ASSERT_TRUE(comes([this] {
            return row(0).field().isVisible() ? named("Copy current").isEnabled()
                                              : button(0, 1).isEnabled();
        })) << said().toStdString();
        QPoint place;
        int looks = 0;  // a press while the view still settles would end at once
        ASSERT_TRUE(comes([&] {
            const QPoint now = row(0).mapToGlobal({});
            looks = now == std::exchange(place, now) ? looks + 1 : 0;
            return looks > 5;
        }));
    }
    explorer::View& view() { return *window.current()->findChild<explorer::View*>(); }
    AxisRows& rows() { return *view().findChild<AxisRows*>(); }
    AxisRow& row(int axis) { return rows().row(axis); }
    QPushButton& button(int axis, int direction) { return row(axis).button(direction); }
    QPushButton& named(const QString& text) {
        for (auto* each : view().findChildren<QPushButton*>()) {
            if (each->text() == text && each->isVisible()) return *each;
        }
        throw std::runtime_error{"no button " + text.toStdString()};
    }
    QSlider& speed() { return view().findChild<MotionBar*>()->slider(); }
    void enter(int axis, const QString& text) {
        QLineEdit& field = row(axis).field();
        field.setFocus();
        field.selectAll();
        QTest::keyClicks(&field, text);
    }
    // All sentences that are seen, and what is said of the rows.
    QString said() {
        QStringList all;
        for (const auto* each : view().findChildren<QLabel*>()) {
            if (each->isVisible() && !each->text().isEmpty()) all << each->text();
        }
        return all.join('|');
    }
    QString saidOf(int axis) { return row(axis).accessibleDescription(); }
    double number(const std::string& path, const char* item) {
        const auto frame = session.frame();
        const explorer::SimplexNow now = explorer::SystemNow{*frame}.at(path);
        if (std::string_view{item} == "state") {
            return now.state() ? static_cast<double>(*now.state()) : -1;
        }
        if (std::string_view{item} == "jogging") return now.text(item) == "true" ? 1 : 0;
        return now.number(item).value_or(std::nan(""));
    }
    std::int64_t cycle() { return session.frame()->agents.front().status.cycle; }
    bool jogs() { return number(jogger, "jogging") == 1; }
    // It is pressed again where the machine held window or agent up, which ends it by itself; that
    // the controller ends it counts only with ticks that were missed.
    bool moves(const std::function<void()>& release, const std::function<void()>& press,
               const std::function<bool()>& hasMoved) {
        double missed = number("/robot", "overflowCount");
        return comes([&] {
            const QString seen = said();
            const int at = seen.indexOf("Ended: ");
            if (at >= 0) endings.insert(seen.mid(at, 120).toStdString());
            const double missedNow = number("/robot", "overflowCount");
            if (seen.contains("Ended: the window hung") || seen.contains("did not answer") ||
                (seen.contains("Ended: the controller") && missedNow > missed)) {
                missed = missedNow;
                release();
                press();
            }
            return jogs() && hasMoved();
        });
    }
    // Says why, and is over in the agent, too; nothing begins anew.
    void ends(const QString& why) {
        EXPECT_TRUE(says("Ended: ")) << said().toStdString();
        EXPECT_TRUE(said().contains("Ended: " + why)) << said().toStdString();
        EXPECT_TRUE(comes([this] { return !jogs(); }));
        const std::int64_t then = cycle();
        bool again = false;
        EXPECT_TRUE(comes([&] {
            again = again || jogs();
            return cycle() > then + 200;
        }));
        EXPECT_FALSE(again);
    }
    bool says(const QString& text) {
        return comes([&] { return said().contains(text); });
    }

    std::string jogger = "/jog";
    std::set<std::string> endings;  // of what was pressed in vain
    Session session;
    MainWindow window;
};

}  // namespace cortex::test
