// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/command_exchange.hpp"
#include "cortex/core/labelled_value.hpp"
#include "cortex/core/nearest_names.hpp"
#include "cortex/core/record.hpp"
#include "cortex/core/simplex_tree.hpp"

#include "live/control.hpp"
#include "live/judged_value.hpp"
#include "live/live_values.hpp"
#include "live/saved_file.hpp"
#include "live/set_parts.hpp"
#include "live/started_anew.hpp"
#include "text/interrupts.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>
#include <list>
#include <map>
#include <set>

namespace cortex::cli {
namespace {

using Arguments = comms::Mirror::Arguments;

// An item whose value is another than that of the file.
struct Difference {
    std::string path;
    const DataItem* item = nullptr;
    Value now, wanted;
};

// Items of one simplex that are set together, and what came of it. All that are to be set, unless
// they are too large for one command.
struct Change {
    std::string path;
    Arguments arguments;
    comms::CommandAnswer answer;
};

struct Plan {
    std::vector<std::shared_ptr<const Structure>> keeps;  // what the items belong to
    std::vector<Difference> differences;
    std::vector<Change> changes;
    Starts starts;         // of the agents that were compared
    std::size_t same = 0;  // items
    Report report;
};

class Planner {
public:
    Planner(Live& live, Plan& plan) : live_{live}, plan_{plan} {}

    void add(const SavedSimplex& saved) {
        const auto found = find(saved);
        if (!found) return;
        if (!saved.type.empty() && saved.type != found->type().name) {
            plan_.report.error(saved.path, "stored-type", saved.place,
                               "the values are of the type " + saved.type + ", the simplex is a " +
                                   found->type().name,
                               "take them out of the file, or write type=\"" + found->type().name +
                                   "\" if they still hold");
            return;
        }
        plan_.starts.try_emplace(found->agent, live_.statusOf(found->agent).epoch);
        const comms::AgentImage image = live_.mirror().image(found->agent);
        const bool same = image && &image->structure() == found->structure.get();
        if (!same || !isLive(image, found->index)) {
            plan_.report.error(saved.path, "no-value", saved.place,
                               "its values did not come from agent " + found->agent,
                               "look whether it runs: cortex agents");
            return;
        }
        plan_.keeps.push_back(found->structure);
        const CommandTable table = commandTable(found->type());
        Change change{saved.path, {}, {}};
        for (const SavedItem& item : saved.items) add(*found, *image, table, item, change);
        for (const Arguments& each : setParts(change.arguments))
            plan_.changes.push_back({saved.path, each, {}});
    }

private:
    std::optional<FoundSimplex> find(const SavedSimplex& saved) {
        std::vector<std::string> paths;
        for (const FoundSimplex& each : live_.below("/")) {
            if (each.info().path == saved.path && each.agent == live_.ownerOf(saved.path)) {
                live_.tellContest(saved.path);
                return each;
            }
            paths.push_back(each.info().path);
        }
        plan_.report.error(saved.path, "unknown-path", saved.place, "no agent has this simplex",
                           nearestNames(saved.path, paths));
        return {};
    }

    void add(const FoundSimplex& simplex, const Image& image, const CommandTable& table,
             const SavedItem& saved, Change& change) {
        const auto wrong = [&](const char* rule, const std::string& message,
                               const std::string& remedy = "") {
            plan_.report.error(change.path, rule, saved.place, message, remedy);
        };
        std::vector<std::string> valid;
        for (const DataItem* each : table.settable) valid.push_back(each->name);
        const ItemLayout* layout = simplex.info().layout->find(saved.name);
        if (layout == nullptr || std::ranges::find(valid, saved.name) == valid.end()) {
            return wrong(layout == nullptr ? "unknown-item" : "not-settable",
                         simplex.type().name +
                             (layout == nullptr ? " has no item '" : " lets nobody set '") +
                             saved.name + "'",
                         nearestNames(saved.name, valid));
        }
        const DataItem& item = *layout->item;
        const auto [value, rule, why] = judgedValue(table, item, saved.value);
        if (!why.empty()) return wrong(rule, why);
        const Value now = image.value(simplex.index, *layout);
        if (toText(now) == toText(value)) {  // 0 and -0 are two values
            ++plan_.same;
            return;
        }
        plan_.differences.push_back({change.path, &item, now, value});
        change.arguments[item.name] = value;
    }

    Live& live_;
    Plan& plan_;
};

// What a person reads of a value: quotes where its end would not be seen.
std::string shownValue(const DataItem& item, const Value& value) {
    const std::string text = toText(value);
    return item.kind == Kind::String && item.length == 1 ? "\"" + text + "\"" : text;
}

void printDifferences(const Plan& plan) {
    Columns columns{0};
    for (const Difference& each : plan.differences) {
        columns.add(
            {each.path + "." + each.item->name,
             shownValue(*each.item, each.now) + " -> " + shownValue(*each.item, each.wanted),
             each.item->unit});
    }
    columns.print(std::cout);
}

Json planJson(const Plan& plan, bool applied) {
    Json differences = Json::array(), results = Json::array();
    for (const Difference& each : plan.differences) {
        differences.push_back({{"path", each.path},
                               {"item", each.item->name},
                               {"now", valueJson(*each.item, each.now)},
                               {"file", valueJson(*each.item, each.wanted)},
                               {"unit", each.item->unit}});
    }
    for (const Change& each : plan.changes) {
        if (!applied) break;
        Json items = Json::array();
        for (const auto& [item, value] : each.arguments) items.push_back(item);
        results.push_back({{"path", each.path},
                           {"items", items},
                           {"outcome", name(each.answer.outcome)},
                           {"reason", each.answer.why}});
    }
    return {{"same", plan.same},
            {"differences", differences},
            {"findings", findingsJson(plan.report)},
            {"results", results}};
}

std::string commonPrefix(const std::string& one, const std::string& other) {
    std::size_t end = 0;
    for (std::size_t i = 0; i <= std::min(one.size(), other.size()); ++i) {
        const bool ends =
            (i == one.size() || one[i] == '/') && (i == other.size() || other[i] == '/');
        if (ends) end = i;
        if (i == one.size() || i == other.size() || one[i] != other[i]) break;
    }
    return end == 0 ? "/" : one.substr(0, end);
}

// Of each agent, one lease on what all changes have in common: an agent has few leases.
std::list<BriefControl> controlOf(Live& live, const Plan& plan) {
    std::map<std::string, std::string> prefixes;
    for (const Change& each : plan.changes) {
        const std::string agent = live.ownerOf(each.path).value_or("");
        const auto [found, added] = prefixes.try_emplace(agent, each.path);
        if (!added) found->second = commonPrefix(found->second, each.path);
    }
    std::list<BriefControl> control;
    for (const auto& [agent, prefix] : prefixes) control.emplace_back(live, agent, prefix);
    return control;
}

// All simplexes share what is left of the time to wait. What has none left is not sent.
Exit apply(Live& live, Plan& plan) {
    Exit exit = Yes;
    for (Change& each : plan.changes) {
        if (live.over()) {
            each.answer.outcome = Outcome::Expired;
            each.answer.why = "not sent, because the time to wait was over (--timeout)";
        } else {
            each.answer = live.call(each.path, "set", each.arguments);
        }
        if (each.answer.done()) continue;
        const bool refused = each.answer.outcome != Outcome::Unknown;
        if (refused || exit == Yes) exit = refused ? No : NotFound;
    }
    return exit;
}

// "/c.gain, /c.offset": what is refused is refused with all that goes with it.
std::string whatChanges(const Change& change) {
    std::vector<std::string> items;
    for (const auto& [name, value] : change.arguments) items.push_back(change.path + "." + name);
    return joined(items);
}

void printResults(const Plan& plan) {
    std::set<std::string> done;
    std::size_t items = 0;
    for (const Change& each : plan.changes) {
        if (each.answer.done()) {
            done.insert(each.path);
            items += each.arguments.size();
        } else {
            std::cerr << "cortex: " << whatChanges(each) << ": " << printable(each.answer.text())
                      << '\n';
        }
    }
    std::cout << "set " << plural(items, "item") << " of " << plural(done.size(), "simplex")
              << '\n';
}

// What was compared with another start of an agent may differ by now.
Exit tellWhoStartedAnew(const Live& live, const Plan& plan) {
    const auto anew = startedAnew(plan.starts, live.mirror().agents());
    for (const std::string& each : anew) {
        std::cerr << "cortex: " << each
                  << " ended or was started anew meanwhile, so not all may be as in the file: "
                     "restore it again\n";
    }
    return anew.empty() ? Yes : No;
}

}  // namespace

Exit restoreItems(const RestoreOptions& options) {
    std::optional<Interrupts> interrupts;
    if (options.take) interrupts.emplace();
    const std::vector<SavedSimplex> saved = readSaved(options.file);
    std::vector<std::string> paths;
    for (const SavedSimplex& each : saved) {
        if (SimplexTree::pathError(each.path).empty()) paths.push_back(each.path);
    }
    Live live{options.network};
    live.actFor(options.person);
    live.view(paths, 100);
    live.waitForAll();
    for (const std::string& each : paths) live.waitForOwner(each);
    live.waitForValues();
    Plan plan;
    Planner planner{live, plan};
    for (const SavedSimplex& each : saved) planner.add(each);
    const bool good = plan.report.ok(), acts = good || options.whatIsGood;
    const bool applies = acts && !options.dryRun;
    if (!options.json && (acts || options.dryRun)) printDifferences(plan);
    std::list<BriefControl> control;
    if (applies && options.take) control = controlOf(live, plan);
    Exit exit = applies ? apply(live, plan) : Yes;
    if (!good) exit = No;
    if (applies && tellWhoStartedAnew(live, plan) != Yes) exit = No;
    if (options.json) {
        print(planJson(plan, applies));
        return exit;
    }
    if (plan.same > 0) std::cout << plural(plan.same, "item") << " as in the file\n";
    printFindings(plan.report, Stream::Errors);
    if (!acts) {
        std::cerr << "cortex: nothing was changed; take these lines out of the file, or set the "
                     "rest with --what-is-good\n";
    }
    if (applies && !plan.changes.empty()) printResults(plan);
    return exit;
}

}  // namespace cortex::cli
