// SPDX-License-Identifier: Apache-2.0
#include "agent/agent_value_watch.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/event_memory.hpp"
#include "cortex/core/labelled_value.hpp"

#include "wire/simplex_marks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace cortex::comms {
namespace {

constexpr std::int64_t lookInterval = nsPerSecond / 5;
constexpr std::int64_t mostOfOne = 10;  // at once
// Of the quality of all simplexes, and of all other values.
constexpr std::int64_t mostOfAll = 250, intervalOfAll = nsPerSecond / 5;
constexpr std::size_t mostElements = 3, roomForElements = 100;  // octets, in a text

// What the framework itself writes: events say how the life cycle and long commands go on.
bool isToldByEvents(const TypeModel& types, const Type& type, const DataItem& item) {
    constexpr std::array<std::string_view, 4> bases{"Active", "Activity", "Agent", "Cluster"};
    return std::ranges::any_of(bases, [&](std::string_view name) {
        const Type* base = types.find(name);
        return base != nullptr && type.isA(name) && base->findData(item.name) != nullptr;
    });
}

// Counts the elements that are other than before.
template <class Function>
std::uint32_t renew(std::span<std::int64_t> seen, Function state) {
    std::uint32_t changes = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::int64_t present = state(i);
        if (std::exchange(seen[i], present) != present) ++changes;
    }
    return changes;
}

void addNumber(EventText& text, const DataItem& item, const Slice& slice, std::size_t place) {
    if (item.kind == Kind::Int) {
        text << slice.ints[place];
    } else {
        const double value = slice.floats[place];
        const bool isBelow = item.min && Number{value} < *item.min;
        text.apart(value, std::get<double>(isBelow ? *item.min : *item.max));
    }
    if (!item.unit.empty()) text << " " << item.unit;
}

void addLabel(EventText& text, const DataItem& item, std::int64_t number) {
    const auto found = item.labels.find(number);
    if (found == item.labels.end())
        text << number;
    else
        text << found->second;
}

}  // namespace

AgentValueWatch::AgentValueWatch(AgentSelf& self) : self_{self} {
    std::map<const TypeLayout*, std::uint32_t> places;
    std::size_t subjects = 0, elements = 0;
    for (const SimplexInfo& info : self_.structure().simplexes) {
        if (info.remote) break;  // they come last
        const auto place = static_cast<std::uint32_t>(types_.size());
        const auto [found, isNew] = places.try_emplace(info.layout, place);
        if (isNew) add(*info.layout);
        typeOf_.push_back(found->second);
        subjects += types_[found->second].size();
        for (const Watched& each : types_[found->second]) elements += each.length;
    }
    subjects_.resize(subjects);
    seen_.resize(elements);
    told_.resize(elements);
}

// A value that is none of its labels is told as a label, not as one outside its limits.
void AgentValueWatch::add(const TypeLayout& layout) {
    std::vector<Watched>& all = types_.emplace_back();
    all.push_back({Sort::Quality, nullptr, 1});
    for (const ItemLayout& each : layout.items) {
        const DataItem& item = *each.item;
        const bool isLabelled = item.kind == Kind::Int && isClosed(item);
        const bool isSwitch = item.kind == Kind::Bool;
        if (isLabelled || isSwitch) {
            if (each.constant || isToldByEvents(*self_.structure().types, *layout.type, item))
                continue;
            all.push_back({isSwitch ? Sort::Switch : Sort::Labels, &each, item.length});
        } else if (isLimited(each)) {
            all.push_back({Sort::Limits, &each, item.length});
        }
    }
}

// Also while the loop stands still, as long as something is to be told.
void AgentValueWatch::step(std::int64_t now) {
    if (now < due_) return;
    const Image image = self_.access.newestImage();
    if (!image || image.cycle() == 0) return;
    due_ = std::max(due_ + lookInterval, now + lookInterval / 2);
    if (image.cycle() != cycle_ || waits_) look(image, now);
}

// The first image is what changes are told against.
void AgentValueWatch::look(const Image& image, std::int64_t now) {
    const bool isFirst = std::exchange(cycle_, image.cycle()) == 0;
    waits_ = false;
    std::size_t subject = 0, element = 0;
    for (std::uint32_t simplex = 0; simplex < typeOf_.size(); ++simplex) {
        const Slice slice = image.slice(simplex);
        for (const Watched& each : types_[typeOf_[simplex]]) {
            const View view{image,
                            slice,
                            simplex,
                            each,
                            std::span{seen_}.subspan(element, each.length),
                            std::span{told_}.subspan(element, each.length)};
            Subject& present = subjects_[subject++];
            element += each.length;
            const bool isGood = slice.state->quality == Quality::Good;
            if (each.sort == Sort::Limits && !isGood) continue;  // as it was before
            const std::uint32_t changes = observe(view);
            if (isFirst) continue;
            present.changes += changes;
            if (present.changes != 0) tell(view, present, now);
        }
    }
    if (isFirst) told_ = seen_;
    if (leftOut_ != 0) tellLeftOut(image, now);
}

std::uint32_t AgentValueWatch::observe(const View& view) {
    const Slice& slice = view.slice;
    const ItemLayout* const layout = view.watched.layout;
    switch (view.watched.sort) {
        case Sort::Quality:
            return renew(view.seen, [&](std::size_t) {
                return static_cast<std::int64_t>(slice.state->quality);
            });
        case Sort::Limits:
            return renew(view.seen, [&](std::size_t i) {
                return std::int64_t{isOutside(*layout, slice, static_cast<std::uint32_t>(i))};
            });
        case Sort::Labels:
            return renew(view.seen, [&](std::size_t i) { return slice.ints[layout->offset + i]; });
        case Sort::Switch:
            return renew(view.seen, [&](std::size_t i) {
                return std::int64_t{slice.bools[layout->offset + i]};
            });
    }
    return 0;
}

// What is told too often waits, and then its newest state is told. What is too much altogether is
// only counted: told later, it would have a wrong time.
void AgentValueWatch::tell(const View& view, Subject& subject, std::int64_t now) {
    if (!subject.allowance.take(now, mostOfOne, nsPerSecond)) {
        waits_ = true;
        return;
    }
    Allowance& all = view.watched.sort == Sort::Quality ? qualities_ : values_;
    if (all.take(now, mostOfAll, intervalOfAll))
        keep(view, subject.changes);
    else
        leftOut_ += subject.changes;
    std::ranges::copy(view.seen, view.told.begin());
    subject.changes = 0;
}

bool AgentValueWatch::isWorse(const View& view, std::size_t element) {
    const std::int64_t present = view.seen[element];
    if (present == view.told[element]) return false;
    switch (view.watched.sort) {
        case Sort::Quality:  // a demand at rest is stale
            return present > view.told[element] &&
                   present >= static_cast<std::int64_t>(Quality::Bad);
        case Sort::Limits:
            return present != 0;
        case Sort::Labels:
            return !view.watched.layout->item->labels.contains(present);
        case Sort::Switch:
            break;
    }
    return false;
}

// One element, as it is and, where it is another one, as it was told last.
EventText AgentValueWatch::say(const View& view, std::size_t element) {
    const std::int64_t present = view.seen[element], before = view.told[element];
    if (view.watched.sort == Sort::Quality) {
        EventText text = "is ";
        text << name(static_cast<Quality>(present));
        if (present != before) text << ", was " << name(static_cast<Quality>(before));
        return text;
    }
    const DataItem& item = *view.watched.layout->item;
    EventText text{item.name};
    if (item.length > 1) text << "[" << element << "]";
    if (view.watched.sort == Sort::Limits && present == 0) return text << " is within its limits";
    if (view.watched.sort == Sort::Limits) {
        text << " is outside its limits: ";
        addNumber(text, item, view.slice, view.watched.layout->offset + element);
        return text;
    }
    const auto add = [&](std::int64_t state) {
        if (view.watched.sort == Sort::Switch)
            text << (state != 0 ? "true" : "false");
        else
            addLabel(text, item, state);
    };
    text << " is ";
    add(present);
    if (isWorse(view, element)) text << ", which is none of its labels";
    if (present != before) {
        text << ", was ";
        add(before);
    }
    return text;
}

void AgentValueWatch::keep(const View& view, std::uint32_t changes) {
    EventText text;
    std::uint32_t named = 0;
    bool worse = false;
    for (std::size_t i = 0; i < view.seen.size(); ++i) {
        if (view.seen[i] == view.told[i]) continue;
        worse = worse || isWorse(view, i);
        const EventText part = say(view, i);
        const std::size_t size = text.view().size() + part.view().size();
        if (named == mostElements || (named > 0 && size > roomForElements)) continue;
        text << (named++ > 0 ? "; " : "") << part.view();
    }
    if (named == 0 && view.seen.size() == 1) text << say(view, 0).view();
    if (named == 0 && view.seen.size() > 1)
        text << view.watched.layout->item->name << " is as it was";
    if (const std::uint32_t left = changes - named; left > 0) {
        text << ", and " << left
             << (left == 1 ? " change that is not kept" : " changes that are not kept");
    }
    const auto& simplexes = self_.structure().simplexes;
    if (view.watched.sort == Sort::Quality && view.seen.front() != 0) {
        const std::uint32_t cause = view.slice.state->cause;
        if (cause < simplexes.size() && cause != view.simplex)
            text << ": first cause " << simplexes[cause].path;
    }
    keep(view.image, worse ? Severity::Warning : Severity::Info, simplexes[view.simplex].path,
         text);
}

void AgentValueWatch::keep(const Image& image, Severity severity, const std::string& path,
                           const EventText& text) {
    self_.access.memory->keep({0, self_.epoch, 0, image.cycle(), image.wallClock(), severity,
                               EventKind::ValueChange, path, std::string{text.view()}});
}

void AgentValueWatch::tellLeftOut(const Image& image, std::int64_t now) {
    if (!rest_.take(now, 1, nsPerSecond)) {
        waits_ = true;
        return;
    }
    EventText text;
    text << leftOut_ << (leftOut_ == 1 ? " change of a value is" : " changes of values are")
         << " not kept: too much changed at once";
    keep(image, Severity::Info, "/" + self_.name, text);
    leftOut_ = 0;
}

}  // namespace cortex::comms
