// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "base/text.hpp"
#include "types/type_merge.hpp"
#include "types/unit.hpp"

#include <algorithm>

namespace cortex {

namespace {

// What of an item has no order: all parents and the child agree on it.
struct Shape {
    const char* attribute;
    const char* rule;
    std::string (*text)(const DataItem& item);
};

constexpr Shape shape[] = {
    {"kind", finding::kindChanged, [](const DataItem& i) { return std::string{name(i.kind)}; }},
    {"length", finding::lengthChanged, [](const DataItem& i) { return std::to_string(i.length); }},
    {"capacity", finding::capacityChanged,
     [](const DataItem& i) { return std::to_string(i.capacity); }},
    {"unit", finding::unitChanged, [](const DataItem& i) { return i.unit; }},
    {"constant", finding::flagChanged,
     [](const DataItem& i) { return std::string{i.constant ? "true" : "false"}; }},
    {"measured", finding::flagChanged,
     [](const DataItem& i) { return std::string{i.measured ? "true" : "false"}; }},
};

std::string safeStated(const Safe& safe) {
    switch (safe.kind) {
        case Safe::Kind::None:
            return "";
        case Safe::Kind::Given:
            return toText(safe.value);
        case Safe::Kind::Hold:
            return "hold";
        case Safe::Kind::Observed:
            return "observed";
        case Safe::Kind::Stop:
            return "stop";
    }
    return "";
}

template <class T>
void tighter(std::optional<T>& bound, const std::optional<T>& other, bool greater) {
    if (!other) return;
    if (!bound || (greater ? *other > *bound : *other < *bound)) bound = other;
}

// A unit that is left open takes the one that somebody states.
void fixUnit(DataItem& item, const std::string& unit) {
    if (item.unit == openUnit && !unit.empty()) item.unit = unit;
}

// Labels are joined: a number has one label, whoever gives it.
void joinLabels(DataItem& item, const DataItem& other, const char* rule, const std::string& from,
                const ItemContext& context) {
    for (const auto& [number, label] : other.labels) {
        const auto [known, added] = item.labels.emplace(number, label);
        if (added || known->second == label) continue;
        context.error(rule,
                      "has the number " + std::to_string(number) + " labelled " +
                          inQuotes(known->second) + " and, " + from + ", " + inQuotes(label),
                      "give one number one label");
    }
}

void intersectRange(DataItem& item, const FromParent<DataItem>& second, const std::string& first,
                    const ItemContext& context) {
    const auto text = [](const std::optional<Number>& bound) {
        return bound ? toText(*bound) : "*";
    };
    const auto range = [text](const DataItem& i) { return text(i.min) + " to " + text(i.max); };
    const std::string before = range(item);
    tighter(item.min, second.item->min, true);
    tighter(item.max, second.item->max, false);
    tighter(item.rate, second.item->rate, false);
    if (item.min && item.max && *item.min > *item.max) {
        context.exclude("range", before, range(*second.item), first, second.parent);
        item.max = item.min;
    }
}

void intersectValues(DataItem& item, const FromParent<DataItem>& second, const std::string& first,
                     const Stated& stated, const ItemContext& context) {
    const DataItem& other = *second.item;
    if (item.hasDefault && other.hasDefault && item.initial != other.initial &&
        !stated("default", false)) {
        context.restate("default", toText(item.initial), toText(other.initial), first,
                        second.parent);
    }
    if (!item.hasDefault && other.hasDefault) {
        item.hasDefault = true;
        item.initial = other.initial;
    }
    if (item.safe.kind != Safe::Kind::None && other.safe.kind != Safe::Kind::None &&
        item.safe != other.safe && !stated("safe", false)) {
        context.restate("safe", safeStated(item.safe), safeStated(other.safe), first,
                        second.parent);
    }
    if (item.safe.kind == Safe::Kind::None) item.safe = other.safe;
}

void intersectSettable(DataItem& item, const FromParent<DataItem>& second, const std::string& first,
                       const ItemContext& context) {
    const StateSet other = second.item->settable;
    if (item.settable.empty() || other.empty()) {
        item.settable = item.settable | other;
        return;
    }
    if ((item.settable & other).empty()) {
        context.exclude("settable", item.settable.text(), other.text(), first, second.parent);
    }
    item.settable = item.settable & other;
}

// What names another item of the type: once named, it stays.
struct Link {
    const char* attribute;
    const char* rule;
    std::string DataItem::* name;
};

constexpr Link links[] = {{"derivativeOf", finding::derivative, &DataItem::derivativeOf},
                          {"above", finding::above, &DataItem::above}};

void intersectLink(const Link& link, DataItem& item, const FromParent<DataItem>& second,
                   const std::string& first, const ItemContext& context) {
    std::string& ours = item.*link.name;
    const std::string& other = second.item->*link.name;
    if (ours.empty()) ours = other;
    if (other.empty() || ours == other) return;
    context.exclude(link.attribute, ours, other, first, second.parent);
}

void narrowLink(const Link& link, DataItem& item, const DataItem& own, const ItemContext& context) {
    std::string& ours = item.*link.name;
    const std::string& now = own.*link.name;
    if (ours.empty()) ours = now;
    if (now.empty() || ours == now) return;
    const std::string attribute = link.attribute;
    context.error(
        link.rule,
        "changes the inherited " + attribute + " from " + inQuotes(ours) + " to " + inQuotes(now),
        "leave " + attribute + " out, or take another name");
}

void finer(double& step, double other) {
    if (step == 0 || (other > 0 && other < step)) step = other;
}

// Narrows `item`, from `first`, to what `second` allows as well.
void intersect(DataItem& item, const FromParent<DataItem>& second, const std::string& first,
               const Stated& stated, const ItemContext& context) {
    DataItem other = *second.item;
    fixUnit(item, other.unit);
    fixUnit(other, item.unit);
    for (const Shape& each : shape) {
        if (each.text(item) == each.text(other)) continue;
        context.exclude(each.attribute, each.text(item), each.text(other), first, second.parent);
        return;
    }
    intersectRange(item, second, first, context);
    intersectValues(item, second, first, stated, context);
    intersectSettable(item, second, first, context);
    for (const Link& each : links) intersectLink(each, item, second, first, context);
    joinLabels(item, other, finding::intersectionEmpty, "in " + second.parent, context);
    item.onLimit = std::max(item.onLimit, other.onLimit);
    item.retain = item.retain || other.retain;
    item.atRest = std::min(item.atRest, other.atRest);
    finer(item.resolution, other.resolution);
    finer(item.deadband, other.deadband);
    if (item.format.empty()) item.format = other.format;
    if (item.description.empty()) item.description = other.description;
}

std::string differentUnits(const std::string& ours, const std::string& theirs) {
    std::string ignored;
    const auto first = parseUnit(ours, ignored), second = parseUnit(theirs, ignored);
    if (!first || !second) return "";
    return first->dimension == second->dimension ? " (the same quantity, another scale)"
                                                 : " (another quantity)";
}

bool keepsShape(const DataItem& item, const DataItem& own, const Stated& stated,
                const ItemContext& context) {
    const DataItem plain;
    bool kept = true;
    for (const Shape& each : shape) {
        const std::string inherited = each.text(item), now = each.text(own);
        if (!stated(each.attribute, now != each.text(plain)) || inherited == now) continue;
        const std::string hint = each.attribute == std::string_view{"unit"}
                                     ? differentUnits(inherited, now)
                                     : std::string{};
        context.error(each.rule,
                      std::string{"changes the inherited "} + each.attribute + " from " +
                          inQuotes(inherited) + " to " + inQuotes(now) + hint,
                      "leave " + std::string{each.attribute} + " out, or take another name");
        kept = false;
    }
    return kept;
}

void narrowRange(DataItem& item, const DataItem& own, const ItemContext& context) {
    const auto widened = [&](const char* attribute, const Number& inherited, const Number& now) {
        context.error(finding::rangeWidened,
                      std::string{"widens the inherited "} + attribute + " from " +
                          toText(inherited) + " to " + toText(now),
                      std::string{"write "} + attribute + "=\"" + toText(inherited) +
                          "\" or narrower, or leave it out");
    };
    if (own.min && item.min && *own.min < *item.min) {
        widened("min", *item.min, *own.min);
    } else if (own.min) {
        item.min = own.min;
    }
    if (own.max && item.max && *own.max > *item.max) {
        widened("max", *item.max, *own.max);
    } else if (own.max) {
        item.max = own.max;
    }
    if (own.rate && item.rate && *own.rate > *item.rate) {
        context.error(
            finding::rateWidened,
            "widens the inherited rate from " + toText(*item.rate) + " to " + toText(*own.rate),
            "write rate=\"" + toText(*item.rate) + "\" or less, or leave it out");
    } else if (own.rate) {
        item.rate = own.rate;
    }
}

void narrow(DataItem& item, const DataItem& own, const Stated& stated, const ItemContext& context) {
    narrowRange(item, own, context);
    if (own.hasDefault) {
        item.hasDefault = true;
        item.initial = own.initial;
    }
    if (own.safe.kind != Safe::Kind::None) item.safe = own.safe;
    if (!own.settable.empty()) {
        if (!item.settable.empty() && !item.settable.contains(own.settable)) {
            context.error(finding::settableWidened,
                          "may be set in more states (" + own.settable.text() + ") than inherited",
                          "write settable=\"" + item.settable.text() + "\" or fewer");
        } else {
            item.settable = own.settable;
        }
    }
    for (const Link& each : links) narrowLink(each, item, own, context);
    if (stated("onLimit", own.onLimit != OnLimit::Clamp)) {
        if (own.onLimit < item.onLimit) {
            context.error(finding::limitLoosened,
                          "loosens the inherited onLimit from fault to clamp", "leave onLimit out");
        }
        item.onLimit = std::max(item.onLimit, own.onLimit);
    }
    if (stated("atRest", own.atRest != AtRest::Safe)) {
        if (own.atRest > item.atRest) {
            context.error(finding::atRest, "frees an inherited item at rest",
                          "leave atRest out, or take another name");
        }
        item.atRest = std::min(item.atRest, own.atRest);
    }
    if (item.retain && !own.retain && stated("retain", false)) {
        context.error(finding::flagChanged, "takes back the inherited retain=\"true\"",
                      "leave retain out, or take another name");
    }
    item.retain = item.retain || own.retain;
    joinLabels(item, own, finding::labelChanged, "in this type", context);
    if (own.resolution != 0) item.resolution = own.resolution;
    if (own.deadband != 0) item.deadband = own.deadband;
    if (!own.format.empty()) item.format = own.format;
    if (!own.description.empty()) item.description = own.description;
}

// The unit's canonical text; without a valid one the item has none.
void canonicalUnit(DataItem& own, const ItemContext& context) {
    if (own.unit.empty() || own.unit == openUnit) return;
    std::string why;
    const auto unit = parseUnit(own.unit, why);
    if (!unit) context.error(finding::unit, "has unit=" + inQuotes(own.unit), why);
    own.unit = unit ? unit->canonical : "";
}

}  // namespace

DataItem mergeData(const std::vector<FromParent<DataItem>>& parents, const DataItem* own,
                   const Stated& stated, const ItemContext& context) {
    if (parents.empty() && stated.lacks("kind")) {
        context.error(finding::kindMissing, "has no kind, and no parent has this name",
                      "write kind=\"float\", \"int\", \"bool\" or \"string\", or correct the name");
    }
    DataItem stating = own ? *own : DataItem{};
    canonicalUnit(stating, context);
    if (parents.empty()) checkShape(stating, stated, context);
    DataItem item = parents.empty() ? stating : *parents.front().item;
    for (std::size_t i = 1; i < parents.size(); ++i) {
        intersect(item, parents[i], parents.front().parent, stated, context);
    }
    if (own) {
        item.definedBy = context.type.type;
        item.place = own->place;
        fixUnit(item, stating.unit);
        if (!parents.empty() && !keepsShape(item, stating, stated, context)) return item;
        fitData(stating, item, context);
        if (parents.empty()) {
            item = stating;
            item.definedBy = context.type.type;
        } else {
            narrow(item, stating, stated, context);
        }
    }
    if (stated.isWhole()) {  // a narrower range may leave inherited labels out
        for (const auto& parent : parents) {
            for (const auto& label : parent.item->labels) stating.labels.erase(label.first);
        }
    }
    if (own || parents.size() > 1) checkData(item, own ? &stating : nullptr, context);
    if (own) item.unknown = own->unknown;
    keepOrigin(item, parents, stated);
    return item;
}

}  // namespace cortex
