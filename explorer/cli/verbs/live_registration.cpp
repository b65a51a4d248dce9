// SPDX-License-Identifier: Apache-2.0
#include "verbs/live_registration.hpp"

#include "cortex/comms/network_options.hpp"
#include "cortex/core/value.hpp"

#include "common/person_name.hpp"
#include "verbs/live_verbs.hpp"

#include <memory>

namespace cortex::cli {
namespace {

// Verbs that join the network of agents.
class LiveVerbs {
public:
    explicit LiveVerbs(Verbs& verbs) : verbs_{verbs} {}

    template <class Options>
    CLI::App* add(const char* name, const char* description, const char* examples,
                  const std::shared_ptr<Options>& options, Exit (*verb)(const Options&)) {
        CLI::App* added = verbs_.add(name, description, examples, options, verb);
        addNetwork(*added, options->network, verbs_.session());
        return added;
    }

private:
    Verbs& verbs_;
};

void addList(LiveVerbs& verbs) {
    verbs.add("agents", "Show the agents on the network",
              R"(Examples:
  cortex agents
  cortex agents --domain 7 --json)",
              std::make_shared<LiveOptions>(), listAgents);
    const auto list = std::make_shared<ListOptions>();
    verbs
        .add(
            "list", "List the simplexes of all agents, or those at and below a path",
            R"(Waits until everything is there; if it does not come in time, says how much is, with exit code 3.
Examples:
  cortex list
  cortex list /arm --timeout 10)",
            list, listSimplexes)
        ->add_option("PREFIX", list->prefix, "Path; all if not given")
        ->type_name("");
}

void addShow(LiveVerbs& verbs) {
    const auto show = std::make_shared<ShowOptions>();
    verbs
        .add("show", "Show everything about one simplex: values, relationships, commands",
             R"(Example:
  cortex show /arm)",
             show, showSimplex)
        ->add_option("PATH", show->path, "Path of the simplex")
        ->required()
        ->type_name("");
}

// A range of CLI11 takes "nan", and calls what is no number out of range.
std::string aNumber(const std::string& text) {
    if (toFloat(text)) return {};
    const std::string digits = text.substr(0, text.find_first_not_of("0123456789.+-"));
    return "'" + text + "' is no number" +
           (toFloat(digits) ? "; write it without a unit: " + digits : "");
}

std::string ofSeconds(const std::string& text) {
    const std::string digits = text.substr(0, text.find_first_not_of("0123456789.+-"));
    if (toFloat(text) || !toFloat(digits)) return aNumber(text);
    return "'" + text + "' is no number; write seconds as a number: " + digits;
}

void addWatch(LiveVerbs& verbs) {
    const auto watch = std::make_shared<WatchOptions>();
    CLI::App* verb = verbs.add(
        "watch", "Print values as they change",
        R"(A line for each value that has changed; with --csv or --json a line for each moment.
Examples:
  cortex watch /arm/axis/1.position
  cortex watch /                           all that there is
  cortex watch /arm /hand.value --rate 30 --csv --count 300 > run.csv)",
        watch, watchValues);
    verb->add_option("PATH[.ITEM]", watch->what,
                     "Simplexes, or single items of them; / is all there is")
        ->required()
        ->type_name("");
    verb->add_option("--rate", watch->rate,
                     "Moments per second at multiples of 1/HZ s, 5 if not given; 0: every cycle")
        ->type_name("HZ")
        ->check(CLI::Range(0, 1'000'000));
    verb->add_option("--count", watch->count, "End after so many moments")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000'000));
    CLI::Option* csv = verb->add_flag("--csv", watch->csv, "Print comma-separated values")
                           ->excludes(verb->get_option("--json"));
    verb->add_flag("--labels", watch->labels,
                   "With --csv: the labels of numbers that have some, instead of the numbers")
        ->needs(csv);
}

// Of a verb that commands. Returns that which takes control.
CLI::Option* addCommanding(CLI::App& verb, CommandingOptions& options) {
    verb.add_option("--for", options.person,
                    "On behalf of whom, for the events of the agent; you if not given; no right "
                    "follows")
        ->type_name("NAME")
        ->check([](const std::string& name) {
            const bool fits = name.size() <= common::longestInCommand;
            return name.empty() || (fits && comms::isPersonName(name))
                       ? ""
                       : "a name has at most 31 bytes of UTF-8, no control characters and brackets "
                         "( ), and no blank at its ends";
        });
    return verb.add_flag(
        "--take", options.take,
        "Take control (the lease) of what is commanded, and release it at the end");
}

void addCall(LiveVerbs& verbs) {
    const auto call = std::make_shared<CallOptions>();
    CLI::App* verb =
        verbs.add("call", "Send a command and wait for its answer",
                  R"(Exit code 0: done, 1: rejected or failed, 3: no answer, 4: still running.
Examples:
  cortex call /arm startup
  cortex call /robot startup prefix=/arm --timeout 60
  cortex call /arm startup --take          where others may command too: docs/leases.md)",
                  call, callCommand);
    verb->add_option("PATH", call->path, "Path of the simplex")->required()->type_name("");
    verb->add_option("COMMAND", call->command, "Name of the command")->required()->type_name("");
    verb->add_option("NAME=VALUE", call->arguments,
                     "Parameters; those not given have their defaults")
        ->type_name("");
    addCommanding(*verb, *call);

    const auto set = std::make_shared<CallOptions>();
    verb = verbs.add("set", "Set settable items of a simplex, all together or none",
                     R"(Examples:
  cortex set /arm gain=0.5 mode=Hold
  cortex set /arm "weights=0.1 0.2 0.3")",
                     set, setItems);
    verb->add_option("PATH", set->path, "Path of the simplex")->required()->type_name("");
    verb->add_option("ITEM=VALUE", set->arguments, "New values")->required()->type_name("");
    addCommanding(*verb, *set);
}

void addLeases(LiveVerbs& verbs) {
    verbs.add(
        "leases", "Show who holds control of what, and since when",
        R"(Commands to what somebody else holds are refused. Take control for one command with --take, or for
longer with 'take PREFIX' in 'cortex shell'.
Example:
  cortex leases)",
        std::make_shared<LiveOptions>(), listLeases);
    verbs.add(
        "people", "Show who is at a window or a shell, with what they hold and ask for",
        R"(People are named as they say (--name of 'cortex shell' and 'cortex-explorer'), and tools as agents
see them. In 'cortex shell', 'handover' and 'ask' take and pass control between them.
Example:
  cortex people)",
        std::make_shared<LiveOptions>(), listPeople);
}

void addTimes(CLI::App& verb, EventOptions& events) {
    CLI::Option* follow = verb.get_option("--follow");
    CLI::Option* since =
        verb.add_option("--since", events.since, "With what agents have kept since then")
            ->type_name("TIME");
    verb.add_option("--until", events.until, "Not later than that, of --since or --before-fault")
        ->type_name("TIME")
        ->excludes(follow);
    CLI::Option* before =
        verb.add_flag("--before-fault", events.beforeFault,
                      "The newest fault at or below PREFIX, and what all agents did before it")
            ->excludes(since)
            ->excludes(follow);
    verb.add_option("--seconds", events.seconds, "How long before it, 10 if not given")
        ->type_name("N")
        ->needs(before)
        ->check(ofSeconds)
        ->check(CLI::Range(0.001, 86'400.0));
}

void addEvents(LiveVerbs& verbs) {
    const auto events = std::make_shared<EventOptions>();
    CLI::App* verb = verbs.add(
        "events", "Print what has happened: the last 1,000 events of each agent",
        R"(With --since also what agents have kept: faults and errors, changes of state, commands with who sent
them, refusals, control, losses, and values that changed their state. Of all else there are the last
1,000 events of an agent. Exit code 3: an agent could not say all that it keeps.
TIME: 90s, 10m, 1h or 2d ago; 14:05 or 14:05:10; 2026-11-29, 2026-11-29T14:05 or 2026-11-29T14:05:10Z;
in UTC, by the clocks of the agents.
Examples:
  cortex events
  cortex events /arm --follow --severity warning
  cortex events /arm --since 1h --kind command        who moved it?
  cortex events --before-fault /arm                   what led to its newest fault?)",
        events, showEvents);
    verb->add_option("PREFIX", events->prefix, "Path; all if not given")->type_name("");
    verb->add_flag("--follow", events->follow,
                   "Go on with those that happen from now on, but for values");
    verb->add_option("--severity", events->severity, "The least: info, warning or error")
        ->type_name("S")
        ->check(CLI::IsMember({"info", "warning", "error"}));
    verb->add_option(
            "--kind", events->kinds,
            "Only of this kind: fault, command, state-change, control, refusal, loss, value, …; "
            "several times for several")
        ->type_name("KIND")
        ->allow_extra_args(false);
    addTimes(*verb, *events);
    verb->add_flag("--csv", events->csv, "Print comma-separated values")
        ->excludes(verb->get_option("--json"));
}

void addSave(LiveVerbs& verbs) {
    const auto save = std::make_shared<SaveOptions>();
    CLI::App* verb = verbs.add("save", "Write the settable items of all agents into a file",
                               R"(Examples:
  cortex save tuned.xml
  cortex save arm.xml /arm --force)",
                               save, saveItems);
    verb->add_option("FILE", save->file, "File to write")->required()->type_name("");
    verb->add_option("PREFIX", save->prefix, "Path at and below which; all if not given")
        ->type_name("");
    verb->add_flag("--force", save->force, "Replace a file that exists");

    const auto restore = std::make_shared<RestoreOptions>();
    verb = verbs.add(
        "restore", "Set the items that a file of 'save' has, showing what changes",
        R"(Where one item of the file cannot be set, all that are wrong are listed and nothing is changed; take
them out of the file, or set the rest with --what-is-good. Then the items of each simplex are set
together. Exit code 1: something was wrong or refused.
Examples:
  cortex restore tuned.xml --dry-run
  cortex restore tuned.xml --what-is-good
  cortex restore tuned.xml)",
        restore, restoreItems);
    verb->add_option("FILE", restore->file, "File that 'save' wrote")->required()->type_name("");
    CLI::Option* dry = verb->add_flag("--dry-run", restore->dryRun, "Only show what would change");
    verb->add_flag("--what-is-good", restore->whatIsGood,
                   "Set the rest where some of the file cannot be set");
    addCommanding(*verb, *restore)->excludes(dry);
}

void addTop(LiveVerbs& verbs) {
    const auto top = std::make_shared<TopOptions>();
    CLI::App* verb = verbs.add(
        "top", "Show agents, loops, states, faults and events as they change",
        R"(On a terminal in place, until q or an interrupt; elsewhere one text after the other, with --json an
object a line. Where it ends by itself, the last moment with agents stays. Exit code 3: no agent came.
Examples:
  cortex top
  cortex top /arm --rate 5
  cortex top --seconds 60 --until-gone)",
        top, showTop);
    verb->add_option("PREFIX", top->prefix,
                     "Path whose states, faults and events count; all if not given")
        ->type_name("");
    verb->add_option(
            "--rate", top->rate,
            "Refreshes per second; if not given 2 on a terminal, 1 for JSON, otherwise 0.2")
        ->type_name("HZ")
        ->check(aNumber)
        ->check(CLI::Range(0.001, 30.0));
    CLI::Option* seconds = verb->add_option("--seconds", top->seconds, "End after so many seconds")
                               ->type_name("N")
                               ->check(ofSeconds)
                               ->check(CLI::Range(0.0, 1e6));
    verb->add_flag("--once", top->once, "Print one moment and end")->excludes(seconds);
    verb->add_flag("--until-gone", top->untilGone,
                   "End when the last agent is gone, after one was there");
}

void addConform(LiveVerbs& verbs) {
    const auto conform = std::make_shared<ConformOptions>();
    CLI::App* verb = verbs.add(
        "conform", "Test whether devices do what their types promise",
        R"(Tests each device by the types that it is, on any agent: a simulator or the real machine. What moves
something or gives it torque is skipped unless --move says how far. All else may lead a device that
only measures, or that is a drive of CiA 402, to Active and back, which needs control as 'cortex call'
does. In the end everything is as it was found, also after Ctrl-C. Exit code 1: a test failed.
Examples:
  cortex conform /drive
  cortex conform /drive --move 0.1 --take      by 0.1 rad or m, to and fro
  cortex conform /gripper/device --move 0.01 --grip 0.03
  cortex conform /a /b --seconds 10 --junit results.xml)",
        conform, testConformance);
    verb->add_option("PATH", conform->paths, "Paths of devices")->required()->type_name("");
    verb->add_option("--move", conform->move,
                     "Move each axis so far either way, in its unit; otherwise nothing moves")
        ->type_name("AMPLITUDE")
        ->check(aNumber)
        ->check(CLI::Range(1e-6, 1e6));
    verb->add_option("--speed", conform->speed,
                     "Greatest share of an axis' greatest speed, 0.25 if not given")
        ->type_name("SHARE")
        ->check(aNumber)
        ->check(CLI::Range(0.01, 1.0));
    verb->add_flag("--home", conform->home, "With --move: let drives look for their zero position");
    verb->add_option("--grip", conform->grip,
                     "Open and close a gripper wholly, and grip what is between its jaws: so many "
                     "metres, 0 for nothing")
        ->type_name("WIDTH")
        ->check(aNumber)
        ->check(CLI::Range(0.0, 10.0));
    verb->add_option("--seconds", conform->seconds, "How long to count exchanges, 60 if not given")
        ->type_name("S")
        ->check(ofSeconds)
        ->check(CLI::Range(0.1, 86400.0));
    verb->add_option("--junit", conform->junit, "Write the results as JUnit XML, too")
        ->type_name("FILE");
    verb->add_flag("--force", conform->force, "Replace a file that exists");
    addCommanding(*verb, *conform);
}

}  // namespace

void addNetwork(CLI::App& verb, NetworkArguments& network,
                const std::shared_ptr<Session>& session) {
    const std::string otherwise = session ? "that of the shell" : "CORTEX_TIMEOUT or 3 s";
    verb.add_option("--timeout", network.timeout,
                    "How long to wait for agents; " + otherwise + " if not given")
        ->type_name("S")
        ->check(ofSeconds)
        ->check(CLI::Range(shortestTimeout, longestTimeout));
    network.session = session;
    if (session) return;
    verb.add_option("--domain", network.domain,
                    "Domain of the agents; CORTEX_DOMAIN or 0 if not given")
        ->type_name("N")
        ->check(CLI::Range(0, comms::lastDomain));
    verb.add_option("--interface", network.interfaces,
                    "Address or name of a network interface to use; CORTEX_INTERFACE or all if "
                    "not given")
        ->type_name("ADDR")
        ->allow_extra_args(false);
    verb.add_option("--peer", network.peers, "Host that multicast does not reach")
        ->type_name("HOST")
        ->allow_extra_args(false);
    verb.add_option("--discovery-server", network.discoveryServer,
                    "HOST:PORT of a Fast DDS Discovery Server, instead of multicast and peers; "
                    "several joined by ';'; CORTEX_DISCOVERY_SERVER or none if not given")
        ->type_name("ADDR");
    verb.add_option("--security", network.security,
                    "Folder made by `cortex security create-agent`; CORTEX_SECURITY or no "
                    "security if not given")
        ->type_name("FOLDER");
}

void addLiveVerbs(Verbs& all) {
    LiveVerbs verbs{all};
    addList(verbs);
    addShow(verbs);
    addWatch(verbs);
    addCall(verbs);
    addLeases(verbs);
    addEvents(verbs);
    addSave(verbs);
    addTop(verbs);
    addConform(verbs);
    verbs.add(
        "doctor", "Look whether this machine and network can run CorteX, with remedies",
        R"(Looks at network interfaces, multicast, ports, buffers, clocks, real-time limits and the agents that
are heard, and changes nothing. Exit code 1: an error; warnings are none.
Examples:
  cortex doctor
  cortex doctor --domain 7 --json)",
        std::make_shared<LiveOptions>(), examine);
}

}  // namespace cortex::cli
