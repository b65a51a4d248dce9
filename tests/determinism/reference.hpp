// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "determinism/observation.hpp"
#include "determinism/reference_model.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::determinism {

// The plain interpreter that the real system is measured by: executes the simplexes one after the
// other in canonical order. It has nothing of the framework but the types of the ontology and the
// behaviour of the tasks.
class Reference {
public:
    // `Arrival`: wrong on purpose, to show that the comparison sees it: a receiver takes commands
    // in the order in which they were sent. `shuffle`: the seed of another order of execution that
    // the relationships allow; 0: the canonical one.
    enum class Merge : std::uint8_t { Canonical, Arrival };
    Reference(const Plan& plan, const TypeModel& types, Merge merge = Merge::Canonical,
              std::uint64_t shuffle = 0);
    Observation run();
    std::vector<NamedType> simplexes() const;

private:
    // reference.cpp
    void addSimplexes();
    void addLinks();
    void decideRoles();
    void findOrder();
    std::vector<int> orderBy(Chance* chance) const;
    std::vector<std::set<int>> dependencies() const;
    void bindLinks();
    void cycle();
    void tick(std::int64_t late);
    void post(int simplex, Severity severity, EventKind kind, std::string text);
    void closeEvents();
    Snapshot snapshot() const;
    int find(const std::string& path) const;
    bool isActive(int simplex) const { return all_[index(simplex)].task != nullptr; }
    static std::size_t index(int simplex) { return static_cast<std::size_t>(simplex); }
    RefSimplex& at(int simplex) { return all_[index(simplex)]; }
    template <class T>
    T& item(int simplex, std::string_view name);

    // reference_world.cpp
    InputPort inputPort(Link& link);
    OutputPort outputPort(Link& link);
    void addSender(int simplex, const SenderPlan& plan);
    void addLife(int simplex, const LifePlan& plan);
    void addChoice(int simplex, std::size_t planned);
    void fillWorld(int simplex);
    Link& linkOf(int simplex, std::size_t planned);

    // reference_task.cpp
    void runTask(int simplex);
    void runHooks(int simplex, const Tick& tick);
    void transition(int simplex);
    bool lifeCycle(int simplex, LifeCycle command);
    bool mayStart(int simplex);
    void enter(int simplex, State to);
    void enterFault(int simplex);
    void fault(int simplex, std::int64_t code, std::string_view text);
    void noteSilence(int simplex);
    std::int64_t ageOf(const SlotState& source, const RefTask& reader) const;
    SlotState readInputs(int simplex, std::int64_t passed);
    void inputLost(int simplex, Link& link);
    void finish(int simplex, SlotState state, std::int64_t elapsed);
    void arbitrate(int simplex);

    // reference_demands.cpp
    void initialiseDemands();
    void latchSafe(int simplex, bool startsUp = false);
    void latchSafe(Link& output, bool startsUp = false);
    void takeSafe(Link& output);
    bool isMoving(const RefSimplex& demand) const;
    void slowDown(Link& output, double elapsed);
    void writeSafe(int simplex);
    void writeSafe(Link& output, bool all = true);
    void putSafe(int simplex, double elapsed);
    void settleSafe(int simplex, double elapsed);
    void tellInVain(int simplex, const Link& output, const std::string& who,
                    const std::string& remedy);
    static bool endsAtItsRange(const RefSimplex& demand, const Item& derivative, std::size_t i);
    LimitFinding limit(RefSimplex& demand, double elapsed);
    LimitFinding limitItems(RefSimplex& demand, double elapsed);
    void findDevices();
    void lookAtDevices(RefSimplex& demand);
    static void standStill(RefSimplex& demand, double elapsed);
    void tellSteps(RefSimplex& demand, LimitFinding& finding);
    void limitOutputs(int simplex, double elapsed);
    void checkValues(int writer, RefSimplex& checked, Record& values);

    // reference_exchange.cpp
    int handOver(int simplex, std::uint64_t wanted);
    bool refuses(Choice& choice);
    bool isReplaced(const Choice& choice, const std::vector<Choice>& choices,
                    std::uint64_t wanted) const;

    // reference_commands.cpp
    Outcome send(SenderHandle& handle, double amount, std::int64_t number);
    void postLifeCycle(int simplex, LifeCycle command, bool later);
    void latchLines();
    void process(int simplex, State state);
    void takeAnswers(Line& line);
    void executeNext(int simplex, State state, Line& line);
    void drainVisitors(int simplex, State state);
    Ending execute(int simplex, State state, const std::string& name, const Arguments& arguments,
                   const Caller& caller, double& sum);
    Ending call(int simplex, const std::string& name, const Arguments& arguments, double& sum,
                bool first, bool cancelling);
    Ending startLong(int simplex, const Command& command, const Arguments& arguments,
                     const Caller& caller, double& sum);
    void stepLong(int simplex);
    void endLong(int simplex, const Ending& ending);
    void cancelLong(int simplex, const std::string& why, bool callHandler,
                    Outcome outcome = Outcome::Cancelled);
    bool leaveLong(int simplex, const std::string& why);
    Ending set(int simplex, State state, const Arguments& arguments);
    void count(const Ending& ending);

    // reference_outside.cpp
    void readOutside();
    void release(std::vector<Visitor*>& waiting, std::vector<Visitor*>& arrivals);
    bool isLifeCycle(const Visitor& visitor);
    bool wouldOvertake(const Visitor& visitor, const Visitor& earlier);
    void deliverLifeCycle(Visitor& visitor);
    void settle(Visitor& visitor, Ending ending);
    void refuseLifeCycle(int simplex, LifeCycle command, const std::string& why);
    void watch(Visitor& visitor);
    void collect();
    Ending group(const std::string& command, const Arguments& arguments, bool first);
    bool groupStep();
    bool groupAsks();
    void groupAsk(int simplex);
    void groupLooks();
    bool groupCovers(int simplex);
    bool groupHas(int simplex);
    bool groupIsThere(int simplex, bool asked);
    bool groupMisses(int simplex);
    int groupBlocker(int simplex);
    void groupFails(int simplex, const std::string& text);
    std::string groupAnswer();

    const Plan& plan_;
    const TypeModel& types_;
    Merge merge_;
    std::uint64_t shuffle_;
    std::uint64_t arrivals_ = 0;
    std::map<const Type*, Shape> shapes_;
    std::vector<RefSimplex> all_;  // sorted by path
    // In the cycle before; true: it was no number.
    std::map<std::pair<const Record*, const DataItem*>, bool> wrongValues_;
    std::deque<Link> links_;
    std::vector<int> order_;             // canonical, of all
    std::vector<int> execution_;         // any order that the relationships allow
    std::vector<int> tasks_;             // in canonical order
    std::vector<std::set<int>> before_;  // by simplex: whom it relies on
    std::vector<int> startLevels_;       // by simplex: how many levels start before it is settled
    int levels_ = 0;
    std::deque<Line> lines_;
    int agent_ = 0;

    std::int64_t cycle_ = 0, now_ = 0, elapsed_ = 0, lastNow_ = -period, nextTick_ = 0;
    std::int64_t stoodUntil_ = -1, stood_ = 0;  // the last standstill of the loop
    std::int64_t reported_ = 0;
    std::vector<std::int64_t> missed_;
    bool haltNext_ = false, halted_ = false;
    std::int64_t overflows_ = 0, commands_ = 0, rejected_ = 0, conflicts_ = 0, limits_ = 0;

    struct Posted {
        std::size_t rank;
        int phase;           // of the cycle: begin, tasks, end
        std::size_t number;  // in this cycle, as posted
        SeenEvent event;
    };
    int phase_ = 0;
    std::vector<Posted> posted_;
    std::size_t nextOutside_ = 0;
    std::map<std::string, std::uint64_t> sequences_;
    std::deque<Visitor> visitors_;
    std::map<std::string, std::vector<Visitor*>> waiting_;  // by sender
    std::vector<Visitor*> active_;

    struct {
        LifeCycle command = LifeCycle::None;
        std::string prefix;
        int level = 0;  // how many are done
        bool posted = false, again = false;
        std::map<int, std::int64_t> asked;  // of this level, with the time before
        std::map<int, std::string> heard;   // of those, since they were asked
        std::set<int> started, missing;     // were Active before; did not follow
        std::map<std::pair<int, std::size_t>, std::string> failures;  // by level and rank
    } group_;
    Observation observation_;

    void postLimits(int simplex, const std::vector<std::string>& texts) {
        for (const std::string& text : texts)
            post(simplex, Severity::Warning, EventKind::Limit, text);
    }
    void tell(int simplex, const std::string& text) {
        if (group_.asked.contains(simplex)) group_.heard[simplex] = text;
    }
};

}  // namespace cortex::determinism
