// SPDX-License-Identifier: Apache-2.0
#include "tasks/demands.hpp"

#include "cortex/core/labelled_value.hpp"

#include "tasks/number_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace cortex::cs {

namespace {

std::uint32_t sizeOf(const DataItem& item) {
    switch (item.kind) {
        case Kind::Bool:
            return item.length;
        case Kind::String:
            return item.length * StringCell::size(item.capacity);
        case Kind::Int:
        case Kind::Float:
            break;
    }
    return item.length * 8;
}

std::uint32_t alignedSize(const DataItem& item) { return (sizeOf(item) + 7U) / 8U * 8U; }

std::byte* cellOf(const Slice& slice, const ItemLayout& layout) {
    return static_cast<std::byte*>(slice.at(layout.item->kind, layout.offset));
}

bool hasSafe(const DataItem& item) { return item.safe.kind != Safe::Kind::None && !item.constant; }

bool isStop(const DataItem& item) { return item.safe.kind == Safe::Kind::Stop; }

// It comes to 0; it is not observed.
bool isStoppedDerivative(const DataItem& item) {
    return isStop(item) && !item.derivativeOf.empty();
}

bool isFree(const DataItem& item) { return item.atRest == AtRest::Writer; }

// By value: 0 is -0, and what stands behind the end of a text does not count.
bool differ(const DataItem& item, const std::byte* one, const std::byte* other,
            std::uint32_t size) {
    if (std::memcmp(one, other, size) == 0) return false;
    for (std::uint32_t i = 0; i < item.length; ++i) {
        if (item.kind == Kind::Float) {
            const auto number = [i](const std::byte* cells) {
                return reinterpret_cast<const double*>(cells)[i];
            };
            if (number(one) != number(other)) return true;
        } else if (item.kind == Kind::String) {
            const auto text = [&](const std::byte* cells) {
                const std::byte* cell = cells + i * StringCell::size(item.capacity);
                return reinterpret_cast<const StringCell*>(cell)->view();
            };
            if (text(one) != text(other)) return true;
        } else {
            return true;
        }
    }
    return false;
}

// Writes a given safe value over cells that have their kind and capacity already.
void store(const DataItem& item, const Value& value, std::byte* cells) {
    const auto element = [&](const auto& list, std::size_t i) {
        return list[list.size() == 1 ? 0 : i];  // one value serves a whole array
    };
    for (std::size_t i = 0; i < item.length; ++i) {
        switch (item.kind) {
            case Kind::Int:
                reinterpret_cast<std::int64_t*>(cells)[i] = element(std::get<0>(value), i);
                break;
            case Kind::Float:
                reinterpret_cast<double*>(cells)[i] = element(std::get<1>(value), i);
                break;
            case Kind::Bool:
                reinterpret_cast<bool*>(cells)[i] = element(std::get<2>(value), i);
                break;
            case Kind::String:
                reinterpret_cast<StringCell*>(cells + i * StringCell::size(item.capacity))
                    ->assign(element(std::get<3>(value), i));
                break;
        }
    }
}

}  // namespace

DemandLimits::DemandLimits(const TypeLayout& layout, const Slice& live, const Slice& accepted,
                           std::uint32_t simplex)
    : simplex_{simplex} {
    const bool elsewhere = accepted.state != nullptr;
    std::size_t size = 0;
    for (const ItemLayout& entry : layout.items) {
        if (!entry.item->constant && !elsewhere) size += alignedSize(*entry.item);
    }
    memory_.resize(size);
    std::byte* next = memory_.data();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const ItemLayout& entry : layout.items) {
        const DataItem& item = *entry.item;
        if (item.constant) continue;
        const bool closed = item.kind == Kind::Int && isClosed(item);
        const bool limited = item.kind == Kind::Float || closed ||
                             (item.kind == Kind::Int && (item.min || item.max));
        const bool plain = item.kind == Kind::Float && item.length == 1 && !item.rate;
        std::byte* previous = elsewhere ? cellOf(accepted, entry) : next;
        items_.push_back({&item, cellOf(live, entry), previous, sizeOf(item), limited, false, plain,
                          closed, leastOf(item), greatestOf(item), item.rate.value_or(infinity),
                          nullptr, item.kind == Kind::Float && item.rate.has_value()});
        if (!elsewhere) next += alignedSize(item);
    }
    for (Item& item : items_) {
        if (!isStoppedDerivative(*item.item)) continue;
        const auto nameOf = [](const Item& each) -> std::string_view { return each.item->name; };
        const auto base = std::ranges::find(items_, item.item->derivativeOf, nameOf);
        if (base != items_.end()) item.base = &*base;
    }
    beginnings_.reserve(items_.size() + 1);  // an array may begin two: a limit, then not finite
    accept();
}

void DemandLimits::setTakers(std::vector<DemandTaker> takers, bool& taken) {
    takers_ = std::move(takers);
    taken_ = &taken;
    taken = false;
    stood_ = true;
    const auto hasRate = [this](std::string_view name) {
        return std::ranges::any_of(
            items_, [&](const Item& each) { return each.item->name == name && each.hasRate; });
    };
    std::size_t size = 0;
    for (Item& item : items_) {
        item.derives = item.item->kind == Kind::Float && hasRate(item.item->derivativeOf);
        size += alignedSize(*item.item);
    }
    takenMemory_.resize(size);
    std::byte* next = takenMemory_.data();
    for (Item& item : items_) {
        if (item.item->kind == Kind::String || item.hasRate || item.derives) continue;
        item.taken = next;
        next += alignedSize(*item.item);
    }
    beginnings_.reserve((2 * items_.size()) + 1);  // and a step of each
}

const std::byte* DemandLimits::previous(const DataItem& item) const {
    const auto found = std::ranges::find(items_, &item, &Item::item);
    return found == items_.end() ? nullptr : found->previous;
}

void DemandLimits::accept() {
    for (const Item& item : items_) std::memcpy(item.previous, item.live, item.size);
}

void DemandLimits::restore() {
    for (const Item& item : items_) {
        copyCells(item.item->kind, item.previous, item.live, item.size);
    }
}

LimitResult DemandLimits::apply(double elapsedSeconds) {
    LimitResult result;
    beginnings_.clear();
    if (taken_ != nullptr) *taken_ = std::ranges::any_of(takers_, &DemandTaker::isConnected);
    for (Item& item : items_) {
        if (!item.limited) continue;
        if (item.plain) {
            const double value = *reinterpret_cast<const double*>(item.live);
            if (value >= item.min && value <= item.max) {
                if (item.inEpisode) follow(item, false, elapsedSeconds);
                continue;
            }
        }
        const bool limitedNow = item.item->kind == Kind::Float
                                    ? applyFloat(item, elapsedSeconds, result)
                                    : applyInt(item, result);
        if (result.notFinite) return result;
        if (limitedNow || item.inEpisode) follow(item, limitedNow, elapsedSeconds);
    }
    if (taken_ == nullptr) return result;
    if (!*taken_) stand(elapsedSeconds);
    if (*taken_ == stood_) devicesChanged();
    return result;
}

// A number without a rate is now at once where its writer went meanwhile.
void DemandLimits::devicesChanged() {
    stood_ = stands();
    for (const Item& item : items_) {
        if (item.taken == nullptr) continue;
        if (stood_) std::memcpy(item.taken, item.live, item.size);
        if (stood_ || !wasTaken_ || item.item->kind != Kind::Float) continue;
        const auto* now = reinterpret_cast<const double*>(item.live);
        const auto* end = now + item.item->length;
        const auto [is, was] = std::mismatch(now, end, reinterpret_cast<double*>(item.taken));
        if (is != end) beginnings_.push_back({item.item, *was, *is, false, false, false, true});
    }
    wasTaken_ = wasTaken_ || !stood_;
}

bool DemandLimits::changedUnseen() const {
    return stands() && wasTaken_ && std::ranges::any_of(items_, [](const Item& each) {
               return each.taken != nullptr && std::memcmp(each.taken, each.live, each.size) != 0;
           });
}

void DemandLimits::stand(double elapsed) {
    for (const Item& item : items_) {
        if (!item.hasRate && !item.derives) continue;
        auto* values = reinterpret_cast<double*>(item.live);
        const auto* previous = reinterpret_cast<const double*>(item.previous);
        const double step = item.rate * elapsed;  // infinite: at rest at once
        for (std::uint32_t i = 0; i < item.item->length; ++i) {
            const bool rests = item.derives && !(std::abs(previous[i]) > step);
            const double change = item.derives ? std::copysign(step, previous[i]) : 0;
            values[i] = rests ? 0 : previous[i] - change;
        }
    }
}

void DemandLimits::follow(Item& item, bool limitedNow, double elapsed) {
    constexpr double silence = 1;  // s
    item.quiet = limitedNow ? 0 : item.quiet + elapsed;
    item.inEpisode = limitedNow || (item.inEpisode && item.quiet < silence);
}

void DemandLimits::found(const Item& item, bool first, double value, double limit, bool byRate,
                         LimitResult& result) {
    result.any = result.limited = true;
    if (!first || item.inEpisode) return;
    beginnings_.push_back({item.item, value, limit, false, byRate, item.closed, false});
}

// What a derivative of an item at the end of its range may be at once: 0, as it goes no further.
bool DemandLimits::standsAtItsEnd(const Item& item, std::uint32_t element) {
    if (item.base == nullptr) return false;
    const double value = reinterpret_cast<const double*>(item.base->live)[element];
    return value <= item.base->min || value >= item.base->max;
}

bool DemandLimits::applyFloat(Item& item, double elapsed, LimitResult& result) {
    auto* values = reinterpret_cast<double*>(item.live);
    const auto* previous = reinterpret_cast<const double*>(item.previous);
    const double step = item.rate * elapsed;
    const bool rated = step < std::numeric_limits<double>::infinity();
    bool any = false;
    const std::uint32_t length = item.size / sizeof(double);
    for (std::uint32_t i = 0; i < length; ++i) {
        const double written = values[i];
        if (!rated && written >= item.min && written <= item.max) continue;
        if (!std::isfinite(written)) {
            result = {true, true, item.item, result.limited};
            beginnings_.push_back({item.item, written, previous[i], true, false, false, false});
            return true;
        }
        const double inRange = std::clamp(written, item.min, item.max);
        const double limited =
            rated ? std::clamp(inRange, previous[i] - step, previous[i] + step) : inRange;
        if (limited == written || (written == 0 && standsAtItsEnd(item, i))) continue;
        values[i] = limited;
        found(item, !any, written, limited, limited != inRange, result);
        any = true;
        const bool faults = inRange != written && item.item->onLimit == OnLimit::Fault;
        if (faults && result.faulting == nullptr) result.faulting = item.item;
    }
    return any;
}

bool DemandLimits::applyInt(Item& item, LimitResult& result) {
    auto* values = reinterpret_cast<std::int64_t*>(item.live);
    const auto* previous = reinterpret_cast<const std::int64_t*>(item.previous);
    const auto bound = [](const std::optional<Number>& number, std::int64_t otherwise) {
        const auto* value = number ? std::get_if<std::int64_t>(&*number) : nullptr;
        return value != nullptr ? *value : otherwise;
    };
    const std::int64_t min = bound(item.item->min, std::numeric_limits<std::int64_t>::min());
    const std::int64_t max = bound(item.item->max, std::numeric_limits<std::int64_t>::max());
    bool any = false;
    for (std::uint32_t i = 0; i < item.item->length; ++i) {
        const std::int64_t written = values[i];
        if (item.closed)  // nothing lies between labels
            values[i] = item.item->labels.contains(written) ? written : previous[i];
        else
            values[i] = std::clamp(written, min, max);
        if (values[i] == written) continue;
        found(item, !any, static_cast<double>(written), static_cast<double>(values[i]), false,
              result);
        any = true;
        const bool faults = item.item->onLimit == OnLimit::Fault;
        if (faults && result.faulting == nullptr) result.faulting = item.item;
    }
    return any;
}

SafeDemands::SafeDemands(const TypeLayout& layout, const Slice& out, const DemandLimits& limits,
                         const TypeLayout* observedLayout, const Slice& observed) {
    std::size_t size = 0;
    for (const ItemLayout& entry : layout.items) {
        if (hasSafe(*entry.item)) size += alignedSize(*entry.item);
    }
    memory_.resize(size);
    std::byte* next = memory_.data();
    for (const ItemLayout& entry : layout.items) {
        const DataItem& item = *entry.item;
        if (!hasSafe(item)) continue;
        const bool given = item.safe.kind == Safe::Kind::Given;
        const ItemLayout* source = latchesObservation(item) && observedLayout != nullptr
                                       ? observedLayout->find(item.name)
                                       : nullptr;
        if (source != nullptr) observedState_ = observed.state;
        items_.push_back({&item, cellOf(out, entry), next, limits.previous(item),
                          source != nullptr ? cellOf(observed, *source) : nullptr, sizeOf(item),
                          given});
        std::memcpy(next, items_.back().out, items_.back().size);
        if (given) store(item, item.safe.value, next);
        if (isStoppedDerivative(item)) std::memset(next, 0, items_.back().size);
        next += alignedSize(item);
    }
    addStops();
    // Before the first startup a demand stands where the plant is expected to be.
    for (const Item& item : items_) {
        if (item.observed != nullptr) std::memcpy(item.safe, item.observed, item.size);
    }
    write();
}

void SafeDemands::addStops() {
    const auto number = [](const auto* cells) { return reinterpret_cast<const double*>(cells); };
    const auto cells = [&](const Item& item) {
        return Stopping::Cells{number(item.previous), reinterpret_cast<double*>(item.safe)};
    };
    for (const Item& derivative : items_) {
        if (!isStoppedDerivative(*derivative.item)) continue;
        for (const Item& item : items_) {
            if (item.item->name != derivative.item->derivativeOf || !isStop(*item.item)) continue;
            stops_.emplace_back(*item.item, *derivative.item, cells(item), cells(derivative));
        }
    }
}

void SafeDemands::latch(Latch why) {
    moved_ = false;
    startsUp_ = why == Latch::Startup;
    takeSafe();
}

void SafeDemands::takeSafe() {
    slows_ = !startsUp_ || isMoving();
    const bool usable = observedState_ != nullptr && observedState_->quality < Quality::Bad;
    for (const Item& item : items_) {
        if (item.given) continue;
        const bool observe = item.observed != nullptr && usable && !(isStop(*item.item) && slows_);
        std::memcpy(item.safe, observe ? item.observed : item.previous, item.size);
        if (!slows_ && isStoppedDerivative(*item.item)) std::memset(item.safe, 0, item.size);
    }
}

void SafeDemands::write() {
    for (const Item& item : items_) copyCells(item.item->kind, item.safe, item.out, item.size);
}

void SafeDemands::hold() {
    for (const Item& item : items_) {
        if (isFree(*item.item)) continue;
        copyCells(item.item->kind, item.safe, item.out, item.size);
    }
}

bool SafeDemands::moved() {
    const auto moved = [](const Item& item) {
        return !isFree(*item.item) && differ(*item.item, item.out, item.safe, item.size);
    };
    if (!moved_) moved_ = std::ranges::any_of(items_, moved);
    return moved_;
}

const DataItem* SafeDemands::writtenInVain(bool sole) const {
    for (const Item& item : items_) {
        if (isFree(*item.item) || !differ(*item.item, item.out, item.safe, item.size)) continue;
        if (sole && !differ(*item.item, item.out, item.previous, item.size)) continue;
        return item.item;
    }
    return nullptr;
}

std::optional<SafeDemands::Way> SafeDemands::onTheWay() const {
    for (const Stopping& each : stops_) {
        const std::int64_t element = slows_ ? each.moving() : -1;
        if (element >= 0) return Way{&each.derivative(), each.velocity(element), 0};
    }
    for (const Item& item : items_) {
        if (item.item->kind != Kind::Float || !item.item->rate || isFree(*item.item)) continue;
        if (slows_ && isStop(*item.item)) continue;
        const double min = leastOf(*item.item), max = greatestOf(*item.item);
        for (std::uint32_t i = 0; i < item.item->length; ++i) {
            const double value = reinterpret_cast<const double*>(item.previous)[i];
            const double safe = reinterpret_cast<const double*>(item.safe)[i];
            if (!std::isfinite(safe) || value == std::clamp(safe, min, max)) continue;
            return Way{item.item, value, safe};
        }
    }
    return std::nullopt;
}

bool SafeDemands::observationIsGood() const {
    return observedState_ == nullptr || observedState_->quality == Quality::Good;
}

}  // namespace cortex::cs
