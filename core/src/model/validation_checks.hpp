// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/core/structure.hpp"

#include <string>
#include <string_view>
#include <unordered_set>

namespace cortex {

// What the checks of validate() look at, and where they report. The structure holds what could be
// resolved of the tree.
struct Checked {
    const SimplexTree& tree;
    const Structure& structure;
    Report& report;
    // Paths that stand in the system file, also of simplexes that were refused.
    std::unordered_set<std::string_view> declared;

    const SimplexInfo& info(const Simplex& simplex) const {
        return structure.simplexes[structure.find(simplex.path())];
    }
};

void checkModel(const Checked& checked);
void checkSimplex(const Checked& checked, const Simplex& simplex);
void checkRelations(const Checked& checked, const Simplex& simplex);
// The rule that a relation with an unknown one is taken to mean; "" if none is near or fits.
std::string meantRule(const Checked& checked, const Simplex& owner,
                      const Simplex::Relation& relation);
void checkCounts(const Checked& checked, const Simplex& simplex);
// How old what its inputs read may be.
void checkAges(const Checked& checked, const Simplex& simplex);
// Items that belong together but have different units.
void checkUnits(const Checked& checked, const Simplex& owner);
// Ranges of rotary axes that look like degrees.
void checkAngles(const Checked& checked);
void checkSettings(const Checked& checked, const Simplex& simplex);
// Items that must be above another one, as settings and defaults give them.
void checkAboveOther(const Checked& checked, const Simplex& simplex);
void reportUnknownItem(const TypeModel& types, const Simplex& simplex,
                       const Simplex::Setting& setting, Report& report);
// Over all relationships: writers, demands without a safe value, loops.
void checkFlow(const Checked& checked);
// Inputs that react to a loss, and can never see one, as nobody writes them.
void checkUnwritten(const Checked& checked);
// Demands that a delayed output makes observations, so that no safe value stands.
void checkDelayedDemands(const Checked& checked);

// "rule 'axes' (robotics-morphology.xml:14)"; without the place where the finding itself has it.
std::string ruleText(const Simplex& owner, const Rule& rule);
Place placeFor(const Simplex& owner, const Rule& rule);
// Simplexes that could be related under the rule and are not yet. For an output first those that
// nobody writes; then those beside what others of the owner's type relate, those that none of them
// relates before the rest, then the nearest.
// None when the report is long already: looking for them takes time.
std::vector<std::string> fitting(const Checked& checked, const Simplex& owner, const Rule& rule);

}  // namespace cortex
