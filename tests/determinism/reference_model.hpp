// SPDX-License-Identifier: Apache-2.0
// What the reference consists of: plain records, lists and pointers.
#pragma once

#include "cortex/core/type_model.hpp"

#include "determinism/behaviour.hpp"
#include "determinism/plan.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::determinism {

// How a command ended, in the reference.
struct Ending {
    Outcome outcome = Outcome::Done;
    Reason reason = Reason::None;
    std::string why;
};

// The data of one simplex, or a copy of it.
struct Flag {
    bool on = false;
};
struct Record {
    std::vector<double> floats;
    std::vector<std::int64_t> ints;
    std::vector<Flag> flags;
    std::vector<std::string> texts;
    SlotState state;
};
struct Item {
    const DataItem* type = nullptr;
    std::size_t first = 0;  // in the list of its kind
};
struct Shape {
    std::vector<Item> items;  // by name
    Record initial;

    explicit Shape(const Type& type);
    Shape() = default;
    const Item* find(std::string_view name) const;
};

using Arguments = std::map<std::string, Value>;

struct SenderHandle;
struct Link;
struct SentCommand {
    SenderHandle* handle;
    std::uint64_t number;
    std::int64_t cycle;
    std::uint64_t arrival;  // counts all commands of the system
    Arguments arguments;
};
struct AnswerOnLine {
    SenderHandle* handle;
    SeenAnswer answer;
    std::string why;
};
// Commands from one simplex to another along one relationship, and the answers.
struct Line {
    const Link* link = nullptr;
    bool delayed = false, refusing = false;
    std::uint32_t capacity = 0;
    std::deque<SentCommand> sent;
    std::deque<AnswerOnLine> answers, finals;
    std::uint64_t posted = 0, taken = 0;
    // What the other end may see of a delayed relationship.
    std::size_t visibleSent = 0, visibleAnswers = 0, visibleFinals = 0;
};
struct SenderHandle {
    Line* line = nullptr;
    const SenderPlan* plan = nullptr;
    SeenAnswer answer{};
    std::string why;
    bool full = false;
};

// A command from outside.
struct Visitor {
    const OutsideCommandPlan* plan = nullptr;
    std::uint64_t sequence = 0;
    std::int64_t cycle = 0;  // in which it came
    int simplex = 0;
    std::int64_t waitUntil = 0;  // for earlier ones in queues
    bool queued = false;
    std::string withdrawnBy{};     // the command that went first
    std::optional<Ending> ending;  // or Running, not yet told
    std::int64_t latency = 0;
    bool over = false;
    LifeCycle watched = LifeCycle::None;
    std::int64_t deadline = 0, takenCycle = 0;
    State before = State::Standby;
    bool moved = false;
};

// Who sent a command, along a relationship or from outside.
struct Caller {
    SenderHandle* handle = nullptr;
    Visitor* visitor = nullptr;
    std::uint64_t number = 0;
    std::int64_t cycle = 0;
};

// The long command that runs, or the last.
struct LongCommand {
    const Command* command = nullptr;  // null: none runs
    Caller caller;
    std::int64_t since = 0;
    Arguments arguments;
    double sum = 0;
    bool startedNow = false;
};

struct Link {  // a relationship
    std::size_t number = 0;
    int owner = 0, target = 0;
    const Rule* rule = nullptr;
    bool delayed = false;
    std::size_t plan = 0;  // its place in the plan of the owner
    Record *source = nullptr, *seen = nullptr;
    std::unique_ptr<Record> copy;  // held, or a writer's own
    bool lost = false;
    std::int64_t maxAge = 0;
    // Of an output that is a demand.
    Record safe;
    const Record* observed = nullptr;
    const Shape* observedShape = nullptr;
    const DataItem* refused = nullptr;
    bool refusedNotFinite = false;
    bool notFinite = false;  // in this run
    bool moved = false;      // by a hook, since its safe value was latched
    bool standsSafe = true;  // in this run
    bool startsUp = false;   // its safe value was latched by a startup
    bool slows = false;      // what stops does so: not from rest on in a startup
};

// One of those that a task hands demands over between.
struct Choice {
    int target = 0;
    bool later = false;  // delayed
    const std::int64_t* state = nullptr;
    std::int64_t askedAt = -1, askedIn = -1, activeSince = -1;
};

struct RefTask {
    const SimplexPlan* plan = nullptr;
    int every = 1, phase = 0;
    std::int64_t lastRun = 0, stateSince = 0, now = -1;
    State state = State::Standby;
    bool done = false, dead = false, faultPending = false, qualitySet = false, safeByLoss = false;
    std::string lostText;     // why it is safe by loss
    bool toldInVain = false;  // in this stay
    Quality quality = Quality::Good;
    std::int64_t measuredAt = 0, faultCode = 0;
    std::vector<std::pair<std::int64_t, std::int64_t>> silences;  // ns; until which stamp, length
    std::string text;
    bool pending[4]{}, pendingLater[4]{};  // by LifeCycle
    int manager = -1;
    std::unique_ptr<Behaviour> behaviour;
    World world;
    std::deque<SenderHandle> handles;
    std::vector<Choice> choices;
    std::vector<Link*> inputs, outputs;  // outputs: to descriptive simplexes
};

struct RefSimplex {
    std::string path;
    const Type* type = nullptr;
    const Shape* shape = nullptr;
    Record live, latch;
    std::size_t rank = 0;
    std::vector<Link*> links;
    std::vector<int> writers;
    bool delayedOutput = false, demand = false;
    // A demand: what it was, and which items are limited, or were lately.
    Record previous;
    std::vector<bool> inEpisode;
    std::vector<double> quiet;  // s of the episode in which nothing was limited
    std::vector<int> devices;   // that read it
    Record whenLost;            // as it was when the last of them went
    bool taken = true, wasTaken = false, stood = true;
    // With several writers.
    std::vector<Link*> candidates;
    std::size_t selected = 0;
    bool inConflict = false;
    // Commands.
    std::vector<Line*> sending, receiving;
    std::vector<Visitor*> visitors;
    LongCommand longCommand;
    std::unique_ptr<RefTask> task;
};

struct LimitFinding {
    bool limited = false, notFinite = false, faults = false;
    const DataItem* item = nullptr;  // that faults
    std::vector<std::string> texts;  // of items newly limited
    std::vector<std::string> steps;  // while no device was connected
};

inline bool resting(State state) { return state == State::Standby || state == State::Fault; }
inline bool passing(State state) { return !resting(state) && state != State::Active; }

// Numbers as they stand in texts.
std::string inText(double number);
std::string inText(double number, double other);  // so that they look different
// As much of a text as fits; all texts here are ASCII.
std::string cut(std::string_view text, std::size_t capacity);
std::string inEvent(std::string_view text);  // what does not fit ends at a word, with "…"
// "add needs Active, is Standby"
std::string needs(const std::string& what, const StateSet& states, State state);

}  // namespace cortex::determinism
