// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/nearest_names.hpp"

#include "live/live_models.hpp"
#include "models/type_json.hpp"
#include "models/type_text.hpp"
#include "verbs/verbs.hpp"

#include <iostream>

namespace cortex::cli {
namespace {

[[noreturn]] void unknownType(const TypeModel& types, const std::string& wrong) {
    std::vector<std::string> names;
    for (const auto& [typeName, type] : types.types()) names.push_back(typeName);
    const std::string nearest = nearestNames(wrong, names);
    throw Failure{NotFound,
                  "there is no type '" + wrong + "'; " +
                      (nearest.empty() ? "'cortex types' lists all " + std::to_string(names.size())
                                       : nearest)};
}

void refuseFileAsType(const std::string& type) {
    if (!looksLikeFile(type)) return;
    throw Failure{Usage, "'" + type + "' is a file, not a type; did you mean --file " + type + "?"};
}

// What follows --file is taken for files, a type's name too.
void explainTypeAsFile(const TypesOptions& options, Report& report) {
    const std::string last = options.files.back().string();
    if (options.type || options.files.size() == 1 || last.find('.') != std::string::npos) return;
    for (Finding& finding : report.findings) {
        if (!finding.message.starts_with("there is no file '" + last + "'")) continue;
        finding.remedy = "correct the name, or name a type before --file: cortex types " + last +
                         " --file " + options.files.front().string();
    }
}

void printTypes(const TypeModel& types, const TypesOptions& options) {
    const bool one = options.type.has_value();
    const Type* type = one ? types.find(*options.type) : nullptr;
    if (one && type == nullptr) unknownType(types, *options.type);
    if (options.json && one) {
        print(typeJson(types, *type));
    } else if (options.json) {
        Json list = Json::array();
        for (const auto& [typeName, each] : types.types()) list.push_back(typeSummaryJson(each));
        print({{"types", list}});
    } else if (one) {
        printType(std::cout, types, *type);
    } else {
        printTypeTree(std::cout, types);
    }
}

}  // namespace

// Without files: those of all agents on the network.
Exit showTypes(const TypesOptions& options) {
    if (options.files.empty()) {
        if (options.type) refuseFileAsType(*options.type);
        Live live{options.network};
        live.waitForAll();
        const std::string lacking = live.incomplete();
        if (options.json && !lacking.empty()) throw Failure{NotFound, lacking};
        printTypes(typesOf(live), options);
        if (!lacking.empty()) throw Failure{NotFound, lacking};
        return Yes;
    }
    Model model = readTypes(options.files);
    explainTypeAsFile(options, model.report);
    requireValid(model);
    printTypes(model.types(), options);
    return Yes;
}

}  // namespace cortex::cli
