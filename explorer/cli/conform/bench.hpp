// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conform/judgement.hpp"
#include "conform/plant.hpp"
#include "conform/recording.hpp"
#include "live/control.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cortex::cli::conform {

// What the tests may do.
struct Wishes {
    std::optional<double> move;  // amplitude, in the unit of the axis; none: nothing moves
    std::optional<double> grip;  // m, between the jaws of a gripper, 0: nothing; none: no gripping
    double speed = 0.25;         // greatest share of an axis' greatest speed
    bool home = false, take = false;
    double seconds = 60;  // how long exchanges are counted
};

struct Trial;

// One device on the bench: what is seen of it, and commands to it. Whatever is changed is put back
// on every way out. Main thread.
class Bench {
public:
    using Arguments = comms::Mirror::Arguments;

    // Takes control where that is wished. Throws Failure.
    Bench(Live& live, Plant plant, const Wishes& wishes);
    ~Bench();  // puts back, and says on standard error what could not be
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    const Plant& plant() const { return plant_; }
    const Wishes& wishes() const { return wishes_; }
    Recording& recording() { return *recording_; }
    Sample now() const { return recording_->latest(); }
    // The item as it is at the moment, also a constant. None: there is none such.
    std::optional<Value> value(std::uint32_t simplex, std::string_view item) const;
    double constant(std::uint32_t simplex, std::string_view item, std::size_t element = 0) const;
    std::string label(std::uint32_t simplex, std::string_view item, std::int64_t number) const;
    std::string faultText(std::uint32_t simplex) const;  // " (no power)"; "": it is in no fault
    void needGood(std::uint32_t observation) const;      // throws Ended where it is not
    double period() const;                               // s, of the agent

    // Sends a command and waits for its answer, so many seconds beyond the usual time at most, and
    // while `goesOn`. Throws Ended where control or a right is lacking.
    comms::CommandAnswer call(std::uint32_t simplex, const std::string& command,
                              const Arguments& arguments = {}, double seconds = 0,
                              const std::function<bool()>& goesOn = {});
    // Leads it to Standby or Active, and remembers in which state it was found. Throws Ended.
    void bring(std::uint32_t simplex, State wanted);
    // The state in which it was before a test changed it.
    State found(std::uint32_t simplex) const;
    void set(std::uint32_t simplex, const std::string& item, Value value);  // put back later
    void undoLater(std::function<void()> undo) { undo_.push_back(std::move(undo)); }
    // The same, once all are in the states in which they were found.
    void undoAtRest(std::function<void()> undo) { undoAtRest_.push_back(std::move(undo)); }
    // Undoes what was changed, the last first, and leads to the states that were found; an
    // interrupt does not end it. What is not as before, in words; "": nothing.
    std::string putBack();
    // The same without waiting for a state: a command of which nobody needs the answer.
    void quietly(std::uint32_t simplex, const std::string& command,
                 const Arguments& arguments = {});

    std::map<std::size_t, std::shared_ptr<const Trial>> trials;  // by the place of the axis

private:
    void takeControl();
    void leadBack(std::uint32_t simplex, State to);
    // Why it was not done; "": it was.
    std::string order(std::uint32_t simplex, const std::string& command,
                      const Arguments& arguments);

    Live& live_;
    Plant plant_;
    Wishes wishes_;
    std::vector<std::unique_ptr<BriefControl>> control_;
    std::unique_ptr<Recording> recording_;
    std::vector<std::pair<std::uint32_t, State>> found_;  // in the order in which they were led
    std::set<std::pair<std::uint32_t, std::string>> changed_;  // items that are put back
    std::vector<std::function<void()>> undo_, undoAtRest_;
    std::vector<std::string> left_;  // what putBack() could not put back
};

std::string stateText(const Sample& sample, std::uint32_t simplex);

}  // namespace cortex::cli::conform
