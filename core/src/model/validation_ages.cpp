// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"
#include "model/validation_checks.hpp"

#include <cmath>
#include <vector>

namespace cortex {
namespace {

constexpr double longestUsual = 10;  // s; whoever writes more may have meant ms

// Hz as the system file says; 0 if it does not, or if the agent is one of several clusters.
double frequencyOf(const SystemDescription& system) {
    if (system.clusters.size() != 1) return 0;
    const auto& attributes = system.clusters.front().attributes;
    const auto found = attributes.find("frequency");
    return found != attributes.end() ? toFloat(found->second).value_or(0) : 0;
}

// The ages of the inputs of one simplex: of its rules, and of its relations.
class Ages {
public:
    Ages(const Checked& checked, const Simplex& owner)
        : checked_{checked},
          owner_{owner},
          relations_{resolveRelations(checked.tree, owner)},
          frequency_{frequencyOf(checked.tree.description())} {}

    void check() const {
        for (std::size_t first = 0, end = 0; first < relations_.size(); first = end) {
            bool areRight = true;
            for (; end < relations_.size() && relations_[end].rule == relations_[first].rule;
                 ++end) {
                areRight = isRight(relations_[end]) && areRight;
                checkLong(relations_[end], end == first);
            }
            if (areRight) checkRaised(first, end);
        }
    }

private:
    bool isRight(const ResolvedRelation& each) const {
        const double own = each.relation->maxAge;
        const auto error = [&](const char* rule, const std::string& message,
                               const std::string& remedy) {
            checked_.report.error(owner_.path(), rule, each.relation->place,
                                  ruleText(owner_, *each.rule) + message, remedy);
            return false;
        };
        if (own == 0) return true;
        if (each.rule->direction == Direction::Output)
            return error(finding::onLossDirection, " is an output, and this <relate> has maxAge",
                         "leave maxAge out: who reads what is written states it");
        if (!std::isfinite(own) || own < 0)
            return error(finding::maxAge, ": maxAge is " + toText(own),
                         "give a number of seconds above 0");
        if (own < each.rule->maxAge)
            return error(finding::maxAge,
                         ": maxAge=\"" + toText(own) + "\" is below that of the rule, which is " +
                             toText(each.rule->maxAge) + ", and a <relate> can only raise it",
                         "leave it out, or restate the rule in a type of your own");
        return true;
    }

    void checkLong(const ResolvedRelation& each, bool isFirst) const {
        const bool isOwn = each.relation->maxAge != 0;
        const double age = each.maxAge();
        const bool isInput = each.rule->direction == Direction::Input;
        if (!isInput || age <= longestUsual || (!isOwn && !isFirst)) return;
        constexpr double inSeconds = 1e-3;
        checked_.report.warning(
            owner_.path(), finding::maxAge, each.relation->place,
            ruleText(owner_, *each.rule) + (isOwn ? ": maxAge=\"" : " has maxAge=\"") +
                toText(age) + "\", so that a value of " + toText(age) + " s ago still counts",
            "maxAge is in seconds: if milliseconds were meant, write maxAge=\"" +
                toText(age * inSeconds) + '"');
    }

    // In cycles; 0: nobody of this agent writes it.
    int writtenEvery(const ResolvedRelation& each) const {
        const std::uint32_t source = checked_.structure.find(each.relation->target);
        if (source == noSimplex) return 0;
        const SimplexInfo& info = checked_.structure.simplexes[source];
        const bool written = info.role == Role::Active || !info.writers.empty();
        return written && !info.remote ? static_cast<int>(checked_.structure.writtenEvery(source))
                                       : 0;
    }

    // What the running agent raises; one finding a rule, for what is written least often.
    void checkRaised(std::size_t first, std::size_t end) const {
        const ResolvedRelation* slowest = nullptr;
        const auto least = [&](const ResolvedRelation& each) {
            return 3.0 * writtenEvery(each) / frequency_;
        };
        for (std::size_t i = first; i < end; ++i) {
            const ResolvedRelation& each = relations_[i];
            const bool isStated = each.maxAge() != Rule{}.maxAge;
            if (frequency_ == 0 || each.rule->direction == Direction::Output || !isStated) continue;
            if (each.maxAge() >= least(each)) continue;
            if (slowest == nullptr || writtenEvery(each) > writtenEvery(*slowest)) slowest = &each;
        }
        if (slowest == nullptr) return;
        const int every = writtenEvery(*slowest);
        const bool isOwn = slowest->relation->maxAge != 0;
        checked_.report.warning(
            owner_.path(), finding::maxAge, slowest->relation->place,
            ruleText(owner_, *slowest->rule) + (isOwn ? ": maxAge=\"" : " has maxAge=\"") +
                toText(slowest->maxAge()) +
                (isOwn ? "\" is raised to " : "\", which is raised to ") + toText(least(*slowest)) +
                ": three periods of " + slowest->relation->target + ", written " +
                (every == 1 ? "each cycle" : "every " + std::to_string(every) + " cycles") +
                " at " + toText(frequency_) + " Hz",
            "write maxAge=\"" + toText(least(*slowest)) + "\" or more, or leave it out");
    }

    const Checked& checked_;
    const Simplex& owner_;
    std::vector<ResolvedRelation> relations_;
    double frequency_;
};

}  // namespace

void checkAges(const Checked& checked, const Simplex& simplex) { Ages{checked, simplex}.check(); }

}  // namespace cortex
