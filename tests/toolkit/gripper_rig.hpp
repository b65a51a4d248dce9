// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rig.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace cortex::toolkit::test {

constexpr double workPiece = 0.04;     // m
constexpr double ofAnOpening = 0.001;  // m, tolerance

// What a GripperController says and demands, in each cycle within the limits of its axis.
class GripperRig : public Rig {
public:
    // `hardest`: greatest acceleration of its demand, m/s2.
    explicit GripperRig(double hardest,
                        std::chrono::milliseconds cycle = std::chrono::milliseconds{1})
        : Rig{"rig", cycle}, acceleration_{hardest}, period_{cycle} {}
    enum Object : std::int64_t { Moving, StoppedOpening, StoppedClosing, AtDemand, Lost };

    void begin();  // all is Active
    // Steps; the demand changes no faster than its axis may.
    void go(std::int64_t cycles = 1);
    // Sends a command and goes on until it has ended.
    CallResult ask(const std::string& command, const Arguments& arguments = {});
    CallResult ask(const std::string& command, const std::string& name, double value) {
        return ask(command, {{name, value}});
    }
    bool set(const std::string& path, const std::string& item, const Value& value) {
        return call(path, "set", {{item, value}}).done();
    }
    double width() { return get<double>("/it", "width"); }
    double demand() { return get<double>("/demand", "position"); }
    std::int64_t object() { return get<std::int64_t>("/it", "object"); }
    double force() { return get<double>("/it", "force"); }
    double ahead() { return std::abs(demand() - width()); }
    double mostAhead() const { return mostAhead_; }
    std::int64_t limitCount() { return get<std::int64_t>("/rig", "limitCount"); }
    std::string told();  // texts of all warnings so far, a line each

private:
    struct Told {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Told> told_ = std::make_shared<Told>();
    const double acceleration_;
    const std::chrono::duration<double> period_;
    double velocity_ = 0, mostAhead_ = 0;
};

// Two jaws on the spindle of a simulated CiA 402 drive. They are open at first.
class SlideRig : public GripperRig {
public:
    explicit SlideRig(const std::string& ratedEffort = "70",
                      std::chrono::milliseconds cycle = std::chrono::milliseconds{1});

    // Puts something of this width between the jaws; 0: takes it away.
    bool put(double piece) { return stops(piece, piece == 0 ? 0 : 1); }
    bool stops(double least, double greatest) {
        return set("/drive", "stops", Value{std::vector{least, greatest, 0.0, 0.0}});
    }
    double effort() { return get<double>("/axis", "effort"); }
    bool isWell() {
        return get<std::int64_t>("/axis", "errorCode") == 0 && state("/processor") == State::Active;
    }
};

// A gripper with a status: fingers that go to the demand until something is between them.
class FingerRig : public GripperRig {
public:
    FingerRig();
    void put(double piece);
    void say(std::int64_t status);  // of its axis
    double mayUse();                // force that its fingers may use, as it was told
};

}  // namespace cortex::toolkit::test
