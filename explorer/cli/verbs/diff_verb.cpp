// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/agreement.hpp"

#include "verbs/verbs.hpp"

#include <algorithm>
#include <array>
#include <iostream>

namespace cortex::cli {
namespace {

std::vector<std::string> typesMissingIn(const TypeModel& other, const TypeModel& model) {
    std::vector<std::string> names;
    for (const auto& [name, type] : model.types()) {
        if (other.find(name) == nullptr) names.push_back(name);
    }
    return names;
}

void printList(const std::vector<Disagreement>& disagreements, bool contradictions) {
    for (const Disagreement& each : disagreements) {
        if (each.contradiction != contradictions) continue;
        std::cout << printable(each.text()) << '\n';
    }
}

void printSummary(const std::vector<Disagreement>& disagreements, std::size_t common) {
    const auto contradictions = static_cast<std::size_t>(
        std::ranges::count(disagreements, true, &Disagreement::contradiction));
    const std::size_t differences = disagreements.size() - contradictions;
    if (disagreements.empty()) {
        std::cout << "no disagreement in " << plural(common, "common type") << '\n';
        return;
    }
    std::cout << plural(contradictions, "contradiction") << ", "
              << plural(differences, "difference") << " in " << plural(common, "common type")
              << (contradictions > 0 ? ": what contradicts is not linked\n"
                                     : ": the models can be linked\n");
}

}  // namespace

Exit diffModels(const DiffOptions& options) {
    const Model ours = readTypes(std::array{options.ours});
    const Model theirs = readTypes(std::array{options.theirs});
    requireValid(std::array{&ours, &theirs});
    const auto disagreements = compare(ours.types(), theirs.types());
    const auto onlyOurs = typesMissingIn(theirs.types(), ours.types());
    const auto onlyTheirs = typesMissingIn(ours.types(), theirs.types());
    const std::size_t common = ours.types().types().size() - onlyOurs.size();
    if (options.json) {
        Json list = Json::array();
        for (const Disagreement& each : disagreements) {
            list.push_back({{"type", each.type},
                            {"item", each.item},
                            {"ours", each.ours},
                            {"theirs", each.theirs},
                            {"contradiction", each.contradiction}});
        }
        print({{"common", common},
               {"disagreements", list},
               {"only_ours", onlyOurs},
               {"only_theirs", onlyTheirs}});
    } else {
        printList(disagreements, true);
        printList(disagreements, false);
        const std::array sides{std::pair{&options.ours, &onlyOurs},
                               std::pair{&options.theirs, &onlyTheirs}};
        for (const auto& [file, names] : sides) {
            if (names->empty()) continue;
            std::cout << "only in " << printable(file->string()) << ": "
                      << printable(joined(*names)) << '\n';
        }
        printSummary(disagreements, common);
    }
    return disagreements.empty() ? Yes : No;
}

}  // namespace cortex::cli
