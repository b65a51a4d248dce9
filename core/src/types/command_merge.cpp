// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "types/type_merge.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace cortex {

namespace {

using List = std::vector<DataItem> Command::*;

struct ParameterList {
    const char* name;
    List list;
};
constexpr ParameterList lists[] = {{"request", &Command::request},
                                   {"response", &Command::response}};

std::string namesOf(const std::vector<DataItem>& parameters) {
    std::string result;
    for (const DataItem& each : parameters) result += (result.empty() ? "" : " ") + each.name;
    return result;
}

const DataItem* findIn(const std::vector<DataItem>& parameters, std::string_view name) {
    const auto found = std::ranges::find(parameters, name, &DataItem::name);
    return found == parameters.end() ? nullptr : &*found;
}

// Names and order are the shape of a record; they are those of the first parent, or own if new.
void mergeParameters(Command& command, const std::vector<FromParent<Command>>& parents,
                     const Command* own, const ParameterList& which, const Stated& stated,
                     const ItemContext& context) {
    const std::vector<DataItem> shape = command.*which.list;
    std::vector<DataItem>& merged = command.*which.list;
    merged.clear();
    for (const DataItem& each : shape) {
        if (findIn(merged, each.name)) continue;
        std::vector<FromParent<DataItem>> definitions;
        for (const auto& parent : parents) {
            const DataItem* known = findIn(parent.item->*which.list, each.name);
            if (known) definitions.push_back({known, parent.parent});
        }
        const DataItem* stating = own ? findIn(own->*which.list, each.name) : nullptr;
        const std::string prefix = parameterPrefix(stated.prefix(), which.name);
        const ItemContext parameter{context.type,
                                    context.what + ": " + which.name + " " + inQuotes(each.name),
                                    stating ? stating->place : context.place};
        merged.push_back(mergeData(definitions, stating,
                                   stated.under(dataPrefix(prefix, each.name)), parameter));
    }
}

void sameParameters(const Command& command, const FromParent<Command>& second,
                    const std::string& first, const ItemContext& context) {
    for (const ParameterList& which : lists) {
        const std::string ours = namesOf(command.*which.list);
        const std::string theirs = namesOf(second.item->*which.list);
        if (ours != theirs) context.exclude(which.name, ours, theirs, first, second.parent);
    }
}

void intersect(Command& command, const FromParent<Command>& second, const std::string& first,
               const Stated& stated, const ItemContext& context) {
    const Command& other = *second.item;
    sameParameters(command, second, first, context);
    if (command.isLong != other.isLong) {
        context.exclude("long", command.isLong ? "true" : "false", other.isLong ? "true" : "false",
                        first, second.parent);
    }
    const StateSet both = command.available & other.available;
    if (both.empty()) {
        context.exclude("available", command.available.text(), other.available.text(), first,
                        second.parent);
    } else {
        command.available = both;
    }
    const auto differs = [&](const char* attribute, const std::string& ours,
                             const std::string& theirs) {
        if (ours != theirs && !stated(attribute, false)) {
            context.restate(attribute, ours, theirs, first, second.parent);
        }
    };
    differs("timeout", toText(command.timeout), toText(other.timeout));
    differs("onBusy", name(command.onBusy), name(other.onBusy));
    differs("onInputLost", name(command.onInputLost), name(other.onInputLost));
    differs("onSenderLost", name(command.onSenderLost), name(other.onSenderLost));
    command.confirm = command.confirm || other.confirm;
    command.stops = command.stops && other.stops;
    command.repeated = command.repeated && other.repeated;
    if (command.description.empty()) command.description = other.description;
}

void narrowParameters(const Command& command, const Command& own, const ItemContext& context) {
    for (const ParameterList& which : lists) {
        for (const DataItem& each : own.*which.list) {
            if (findIn(command.*which.list, each.name)) continue;
            context.type.report.error(context.type.type, finding::parametersChanged, each.place,
                                      context.what + " adds the " + which.name + " " +
                                          inQuotes(each.name) + " to an inherited command",
                                      "remove it, or give the command another name");
        }
    }
}

void narrow(Command& command, const Command& own, const Stated& stated,
            const ItemContext& context) {
    if (stated("available", own.available != Command{}.available)) {
        if (!command.available.contains(own.available)) {
            context.error(finding::availabilityWidened,
                          "is available in " + own.available.text() + ", inherited is " +
                              command.available.text(),
                          "write available=\"" + command.available.text() + "\" or fewer states");
        } else {
            command.available = own.available;
        }
    }
    if (stated("long", own.isLong) && own.isLong != command.isLong) {
        context.error(finding::longChanged, "changes the inherited long", "leave long out");
    }
    if (stated("confirm", own.confirm)) {
        if (command.confirm && !own.confirm) {
            context.error(finding::confirmLoosened, "takes back the inherited confirm=\"true\"",
                          "leave confirm out");
        }
        command.confirm = command.confirm || own.confirm;
    }
    const auto onlyTakenBack = [&](const char* name, bool Command::* flag, const char* finding) {
        if (!stated(name, own.*flag)) return;
        if (own.*flag && !(command.*flag)) {
            context.error(finding,
                          std::string{"adds "} + name + "=\"true\" to an inherited command",
                          std::string{"leave "} + name + " out");
        }
        command.*flag = command.*flag && own.*flag;
    };
    onlyTakenBack("stops", &Command::stops, finding::stopsLoosened);
    onlyTakenBack("repeated", &Command::repeated, finding::repeatedLoosened);
    if (stated("timeout", own.timeout != 0)) command.timeout = own.timeout;
    if (stated("onBusy", own.onBusy != OnBusy::Reject)) command.onBusy = own.onBusy;
    if (stated("onInputLost", own.onInputLost != OnInputLost::Fail))
        command.onInputLost = own.onInputLost;
    if (stated("onSenderLost", own.onSenderLost != OnSenderLost::Continue)) {
        command.onSenderLost = own.onSenderLost;
    }
    if (!own.description.empty()) command.description = own.description;
    narrowParameters(command, own, context);
}

void checkNames(const Command& own, const ItemContext& context) {
    for (const ParameterList& which : lists) {
        std::set<std::string_view> names;
        for (const DataItem& each : own.*which.list) {
            const ItemContext parameter{
                context.type, context.what + ": " + which.name + " " + inQuotes(each.name),
                each.place};
            if (!isName(each.name)) {
                parameter.error(finding::name, "is not a name",
                                "write a letter, then letters, digits, - or _; at most 64");
            }
            if (!names.insert(each.name).second) {
                parameter.error(finding::duplicateParameter, "is given twice", "keep one of them");
            }
            const bool other = each.safe.kind != Safe::Kind::None || !each.settable.empty() ||
                               each.constant || each.measured || each.retain || each.rate ||
                               each.onLimit != OnLimit::Clamp || each.atRest != AtRest::Safe ||
                               !each.derivativeOf.empty() || !each.above.empty();
            if (other) {
                parameter.error(finding::parameterAttribute, "has an attribute of data items",
                                "remove safe, settable, constant, measured, retain, rate, "
                                "derivativeOf, above, onLimit and atRest");
            }
        }
    }
}

void check(Command& command, const ItemContext& context) {
    if (!(std::isfinite(command.timeout) && command.timeout >= 0)) {
        context.error(finding::timeout, "has timeout=" + inQuotes(toText(command.timeout)),
                      "write a number of seconds from 0; 0 for none");
        command.timeout = 0;
    }
    for (const ParameterList& which : lists) {
        const std::size_t size = recordSize(command.*which.list);
        if (size <= bounds::recordSize) continue;
        context.error(
            finding::recordSize,
            std::string{"has a "} + which.name + " of " + std::to_string(size) + " octets",
            "shorten arrays and strings to 4096 octets in all");
    }
}

}  // namespace

Command mergeCommand(const std::vector<FromParent<Command>>& parents, const Command* own,
                     const Stated& stated, const ItemContext& context) {
    if (!own && parents.size() == 1) return *parents.front().item;
    Command command = parents.empty() ? *own : *parents.front().item;
    if (own) checkNames(*own, context);
    for (std::size_t i = 1; i < parents.size(); ++i) {
        intersect(command, parents[i], parents.front().parent, stated, context);
    }
    if (own) {
        command.definedBy = context.type.type;
        command.place = own->place;
        command.unknown = own->unknown;
        if (!parents.empty()) narrow(command, *own, stated, context);
    }
    for (const ParameterList& which : lists) {
        mergeParameters(command, parents, own, which, stated, context);
    }
    check(command, context);
    keepOrigin(command, parents, stated);
    return command;
}

}  // namespace cortex
