// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/model_folder.hpp"
#include "drive/action_row.hpp"
#include "drive/axis_band.hpp"
#include "drive/drive_view.hpp"
#include "drive/homing_row.hpp"
#include "drive/state_diagram.hpp"
#include "gui/made_agent.hpp"
#include "model/permission.hpp"
#include "motion/choices.hpp"

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cortex::test {

using drives::Ds402State;
using explorer::AxisBand;
using explorer::DriveView;

// A processor of a type that no view was built for, with two turning axes of one drive: made by
// hand, so that each state and each loss can be shown.
inline TypeModel loadDriveTypes() {
    const ModelFolder folder;
    folder.copyOntology();
    const auto plant = folder.write("plant.xml", R"(<ontology name="plant" version="1.0">
  <include file="drives.xml"/>
  <type name="TurntableProcessor" extends="Ds402AxisProcessor" version="1.0"
        description="Leads the two axes of a turntable."/>
  <type name="TurntableDrive" extends="Ds402SimulatedDrive" version="1.0"
        description="The drive of both axes of a turntable."/>
  <type name="TurntableDemand" extends="RotaryAxisModification" role="modification" version="1.0"
        description="How an axis of the turntable is wished to be.">
    <data name="position" min="-3" max="3"/>
    <data name="velocity" min="-1" max="1"/>
    <data name="effort" min="-20" max="20"/>
  </type>
</ontology>)");
    const std::array files{folder.path() / "cortex-morphology.xml", plant};
    return TypeModel::load(files);
}

inline const TypeModel& driveTypes() {
    static const TypeModel types = loadDriveTypes();
    return types;
}

inline void fillDrives(SimplexTree& tree) {
    Simplex& processor = tree.add("/table/processor", "TurntableProcessor");
    Simplex& drive = tree.add("/table/drive", "TurntableDrive");
    for (const std::string axis : {"a", "b"}) {
        Simplex& says = tree.add("/table/drive/" + axis, "Ds402RotaryObservation");
        Simplex& told = tree.add("/table/set/" + axis, "Ds402RotaryModification");
        Simplex& wished = tree.add("/table/demand/" + axis, "TurntableDemand");
        tree.relate(processor, "drives", says);
        tree.relate(processor, "demands", wished);
        tree.relate(processor, "setpoints", told);
        tree.relate(drive, "demands", told);
        tree.relate(drive, "observations", says);
    }
}

// What a view sends; permission is that of the window.
class RecordingHost : public explorer::Host {
public:
    QString whyNot(const std::string& path, const std::string& command) const override {
        const auto place = frame->find(path);
        if (!place) return QString::fromStdString(path) + " is not heard";
        const Type& type = frame->type(*place);
        const auto found = std::ranges::find(type.commands, command, &Command::name);
        const StateSet available =
            found != type.commands.end() ? found->available : StateSet::always();
        return gui::whyNotNow(*frame, *place, available, command);
    }
    void send(QWidget& /*asker*/, const explorer::Order& order, Done done) override {
        orders.push_back(order);
        if (done) done(answer);
    }
    explorer::Hold* hold(QWidget& /*button*/, const explorer::HeldOrder& /*order*/) override {
        return nullptr;
    }

    std::shared_ptr<gui::Frame> frame;
    std::vector<explorer::Order> orders;
    explorer::Answer answer{true, "Done  1.9 ms, 2 cycles", {}};
};

class DriveRig : public testing::Test {
protected:
    DriveRig() {
        view.setHost(&host);
        for (const SimplexInfo& each : robot.structure->simplexes)
            robot.degrade(each.path, Quality::Good);
        put("/table/processor", "state", 2);
        put("/table/drive", "link", 2);
        for (int axis = 1; axis <= 2; ++axis) put(axis, Ds402State::OperationEnabled);
        view.resize(975, 620);
        view.show();
        for (int frame = 0; frame < 2; ++frame) show();  // the first one makes its parts
    }
    // One element of an item.
    template <class T>
    void put(const std::string& path, const char* item, T value, std::size_t element = 0) {
        const std::uint32_t simplex = robot.at(path);
        const ItemLayout* layout = robot.structure->simplexes[simplex].layout->find(item);
        auto* cells = robot.tables->live(simplex).at(layout->item->kind, layout->offset);
        if (layout->item->kind == Kind::Float)
            static_cast<double*>(cells)[element] = static_cast<double>(value);
        else if (layout->item->kind == Kind::Bool)
            static_cast<bool*>(cells)[element] = value != T{};
        else
            static_cast<std::int64_t*>(cells)[element] = static_cast<std::int64_t>(value);
    }
    void putTexts(const std::string& path, const char* item, std::vector<std::string> texts) {
        const std::uint32_t simplex = robot.at(path);
        const ItemLayout* layout = robot.structure->simplexes[simplex].layout->find(item);
        storeValue(*layout->item, Value{std::move(texts)},
                   robot.tables->live(simplex).at(Kind::String, layout->offset));
    }
    static std::string drive(int axis) { return axis == 1 ? "/table/drive/a" : "/table/drive/b"; }
    static std::string target(int axis) { return axis == 1 ? "/table/set/a" : "/table/set/b"; }
    // An axis is in this state, as its drive says and its processor has heard.
    void put(int axis, Ds402State state) {
        put(drive(axis), "driveState", static_cast<int>(state));
        put(drive(axis), "statusWord",
            state == Ds402State::Unknown ? 0 : drives::rowOf(state)->value | 0x0210);
        put(drive(axis), "modeDisplay", 8);
        put(target(axis), "mode", 8);
        put("/table/processor", "driveState", static_cast<int>(state),
            static_cast<std::size_t>(axis - 1));
    }
    void show(const std::string& agent = "running") {
        host.frame = frameOf({robot.now(agent)});
        host.frame->control.self = "window";
        if (controls) host.frame->control.held = {{"robot", "/", 1}};
        view.bind(explorer::SystemNow{*host.frame});
        view.refresh(explorer::SystemNow{*host.frame});
        QApplication::processEvents();  // what is new is laid out
    }
    AxisBand& band(int axis) { return view.band(axis - 1); }
    QPushButton& action(int axis, const char* command) {
        return band(axis).actions().button(command);
    }
    QPushButton& step(int axis, int number) { return band(axis).diagram().button(number); }
    QPushButton& mode(int axis, int number) {
        return *band(axis).modes().button(QString::number(number));
    }
    static QString saidIn(const QWidget& part) {
        QStringList all;
        for (const auto* each : part.findChildren<QLabel*>()) {
            if (each->isVisibleTo(&part) && !each->text().isEmpty()) all << each->text();
        }
        return all.join('|');
    }
    // The last order in words: "/table/processor enable axis=1".
    std::string sent() {
        if (host.orders.empty()) return "nothing";
        const explorer::Order& order = host.orders.back();
        std::string text = order.path + " " + order.command;
        for (const auto& [name, value] : order.arguments) text += " " + name + "=" + toText(value);
        return text;
    }
    std::string sends(QPushButton& button) {
        host.orders.clear();
        button.click();
        return sent();
    }

    MadeAgent robot{"robot", fillDrives, driveTypes()};
    RecordingHost host;
    DriveView view{"/table/processor"};
    bool controls = true;
};

}  // namespace cortex::test
