// SPDX-License-Identifier: Apache-2.0
#include "live/judged_value.hpp"
#include "live/live_values.hpp"
#include "live/saved_file.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <iostream>
#include <map>

namespace cortex::cli {
namespace {

// What is worth knowing of an item in the file: its label, unit and range.
std::string noteOf(const DataItem& item, const Value& value) {
    std::vector<std::string> parts;
    const std::string shown = exactText(item, value);
    if (!item.labels.empty() && shown != toText(value)) parts.push_back(shown);
    if (!item.unit.empty()) parts.push_back(item.unit);
    if (item.min || item.max) {
        parts.push_back((item.min ? toText(*item.min) : "") + " .. " +
                        (item.max ? toText(*item.max) : ""));
    }
    return joined(parts);
}

SavedSimplex savedOf(const FoundSimplex& simplex, const Image& image) {
    SavedSimplex saved{simplex.info().path, simplex.type().name, {}, {}};
    const CommandTable table = commandTable(simplex.type());
    for (const ItemLayout& each : simplex.info().layout->items) {
        if (each.item->settable.empty()) continue;
        const Value value = image.value(simplex.index, each);
        const std::string text = toText(value);
        saved.items.push_back({each.item->name,
                               text,
                               noteOf(*each.item, value),
                               judgedValue(table, *each.item, text).why,
                               {}});
    }
    return saved;
}

bool hasSettable(const FoundSimplex& simplex) {
    return std::ranges::any_of(simplex.info().layout->items,
                               [](const ItemLayout& each) { return !each.item->settable.empty(); });
}

}  // namespace

// A file is written if anything came; what did not is listed, with exit code 3, and so is what
// nobody could set again. Of a path that
// several agents have, the values of its owner.
Exit saveItems(const SaveOptions& options) {
    checkPrefix(options.prefix);
    if (!options.force) refuseExisting(options.file);
    Live live{options.network};
    live.view({options.prefix}, 100);
    live.waitForAll(options.prefix);
    live.waitForValues();
    std::vector<SavedSimplex> saved;
    std::vector<std::string> missing;
    Json wrong = Json::array();
    std::size_t items = 0;
    live.printWarnings();
    for (const FoundSimplex& each : live.below(options.prefix)) {
        const auto owner = live.ownerOf(each.info().path);
        if (!hasSettable(each) || owner.value_or(each.agent) != each.agent) continue;
        const comms::AgentImage image = live.mirror().image(each.agent);
        const bool same = image && &image->structure() == each.structure.get();
        if (!owner || !same || !isLive(image, each.index)) {
            const std::string& path = each.info().path;  // of several agents: once
            if (missing.empty() || missing.back() != path) missing.push_back(path);
            continue;
        }
        saved.push_back(savedOf(each, *image));
        for (const SavedItem& item : saved.back().items) {
            if (item.wrong.empty())
                ++items;
            else
                wrong.push_back(
                    {{"path", each.info().path}, {"item", item.name}, {"why", item.wrong}});
        }
    }
    const std::string lacking = live.incomplete();
    if (saved.empty() && missing.empty() && lacking.empty()) {
        throw Failure{NotFound, "nothing at or below " + options.prefix + " is settable"};
    }
    if (saved.empty())
        throw Failure{NotFound, "no values came" + (lacking.empty() ? "" : "; " + lacking)};
    const std::string below = options.prefix == "/" ? "" : " at and below " + options.prefix;
    writeSaved(options.file,
               savedText(saved, "Settable items" + below + "; cortex restore sets them again."));
    if (options.json) {
        print({{"file", options.file},
               {"simplexes", saved.size()},
               {"items", items},
               {"missing", missing},
               {"wrong", wrong},
               {"incomplete", lacking}});
    } else {
        std::cout << "saved " << plural(items, "item") << " of " << plural(saved.size(), "simplex")
                  << " in " << printable(options.file) << '\n';
        for (const std::string& each : missing) {
            std::cerr << "cortex: the values of " << each << " did not come\n";
        }
        for (const Json& each : wrong) {
            std::cerr << "cortex: "
                      << printable(each["path"].get<std::string>() +
                                   " is not saved whole: " + each["why"].get<std::string>())
                      << '\n';
        }
        if (!lacking.empty()) std::cerr << "cortex: " << printable(lacking) << '\n';
    }
    return missing.empty() && wrong.empty() && lacking.empty() ? Yes : NotFound;
}

}  // namespace cortex::cli
