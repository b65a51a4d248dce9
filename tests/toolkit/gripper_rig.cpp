// SPDX-License-Identifier: Apache-2.0
#include "gripper_rig.hpp"

#include "cortex/core/agent.hpp"
#include "cortex/cs/simplex_cs.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::toolkit::test {
namespace {

constexpr double fingerSpeed = 0.1;  // m/s

class Fingers final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;
    double piece = 0, mayUse = 0;
    std::int64_t status = 0;  // of its axis

private:
    void populate() override {
        demand_ = input("demands").data<double>("position");
        force_ = input("demands").data<double>("effort");
        position_ = output("opening").data<double>("position");
        status_ = output("opening").data<std::int64_t>("status");
        position_ = opening_;  // where the demand begins
        object_ = output("status").data<std::int64_t>("object");
        on<&Fingers::reconnect>("reconnect");
        data<std::int64_t>("link") = static_cast<std::int64_t>(Link::Open);
    }
    Outcome reconnect(Call&) { return Outcome::Done; }
    void loopEnd(const Tick& tick) override {
        const double way = fingerSpeed * tick.elapsedSeconds(), before = opening_;
        const double aim = std::max<double>(demand_, std::min(piece, opening_));
        if (state() == State::Active) opening_ += std::clamp(aim - opening_, -way, way);
        mayUse = force_;
        position_ = opening_;
        status_ = status;
        if (opening_ != before)
            object_ = GripperRig::Moving;
        else
            object_ = opening_ > demand_ ? GripperRig::StoppedClosing : GripperRig::AtDemand;
    }

    Data<const double> demand_, force_;
    Data<double> position_;
    Data<std::int64_t> object_, status_;
    double opening_ = 0.08;
};

}  // namespace

void GripperRig::begin() {
    cluster().addEventSink([told = told_](const Event& event, const Structure&) {
        if (event.severity != Severity::Error) return;
        const std::lock_guard lock{told->mutex};
        told->text += std::string{event.text.view()} + "\n";
    });
    start();
    step(60);
    startUp();
}

void GripperRig::go(std::int64_t cycles) {
    for (std::int64_t i = 0; i < cycles; ++i) {
        step();
        const double velocity = get<double>("/demand", "velocity");
        EXPECT_LE(std::abs(velocity - velocity_), acceleration_ * period_.count() * (1 + 1e-9));
        velocity_ = velocity;
        mostAhead_ = std::max(mostAhead_, ahead());
    }
}

CallResult GripperRig::ask(const std::string& command, const Arguments& arguments) {
    const std::uint64_t ticket = cluster().send("/it", command, arguments);
    for (int i = 0; i < 70000; ++i) {
        go();
        if (CallResult result; cluster().program().poll(ticket, result)) return result;
    }
    ADD_FAILURE() << command << " did not end";
    return {};
}

std::string GripperRig::told() {
    cluster().agent().events().flush();
    const std::lock_guard lock{told_->mutex};
    return told_->text;
}

SlideRig::SlideRig(const std::string& ratedEffort, std::chrono::milliseconds cycle)
    : GripperRig{5, cycle} {
    add("/axis", "Ds402LinearObservation", {},
        {{"homingNeeded", "false"}, {"ratedEffort", ratedEffort}});
    add("/demand", "SlideGripperAxis");
    add("/set", "Ds402LinearModification");
    add("/drive", "Ds402SimulatedDrive", {{"demands", "/set"}, {"observations", "/axis"}},
        {{"startPosition", "0.1 0"}});
    add("/processor", "Ds402AxisProcessor",
        {{"drives", "/axis"}, {"demands", "/demand"}, {"setpoints", "/set"}});
    add("/it", "GripperController", {{"axes", "/axis"}, {"demands", "/demand"}});
}

FingerRig::FingerRig() : GripperRig{1} {
    classes().add<Fingers>("RobotiqModbusGripper");
    add("/axis", "Robotiq2FingerAxis");
    add("/demand", "Robotiq2FingerAxis");
    add("/status", "GripperStatus");
    add("/fingers", "RobotiqModbusGripper",
        {{"demands", "/demand"}, {"opening", "/axis"}, {"status", "/status"}});
    add("/it", "GripperController",
        {{"axes", "/axis"}, {"demands", "/demand"}, {"status", "/status"}});
}

void FingerRig::put(double piece) { dynamic_cast<Fingers&>(tree().at("/fingers")).piece = piece; }

void FingerRig::say(std::int64_t status) {
    dynamic_cast<Fingers&>(tree().at("/fingers")).status = status;
}

double FingerRig::mayUse() { return dynamic_cast<Fingers&>(tree().at("/fingers")).mayUse; }

}  // namespace cortex::toolkit::test
