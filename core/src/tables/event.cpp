// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/event.hpp"

#include "cortex/core/clock.hpp"
#include "cortex/core/data.hpp"
#include "cortex/core/event_fold.hpp"
#include "cortex/core/printable.hpp"
#include "cortex/core/service_threads.hpp"

#include "types/enum_names.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace cortex {

template <>
inline constexpr std::array spellings<EventKind>{
    "state change", "fault",    "refusal", "overflow", "limit", "conflict", "agent",
    "command",      "watchdog", "message", "control",  "loss",  "value"};

namespace {

constexpr std::size_t usualBatch = 256;  // events handed out at once; more grow the buffer
constexpr std::chrono::milliseconds shortestPause{10}, longestPause{40};  // while nothing happens

std::string padded(unsigned number, std::size_t digits) {
    const std::string text = std::to_string(number);
    return std::string(digits - std::min(digits, text.size()), '0') + text;
}

std::string utcText(std::int64_t wallClock) {
    using namespace std::chrono;
    const sys_time<nanoseconds> time{nanoseconds{wallClock}};
    const auto day = floor<days>(time);
    const year_month_day date{day};
    const hh_mm_ss clock{floor<milliseconds>(time - day)};
    const auto two = [](auto number) { return padded(static_cast<unsigned>(number), 2); };
    return padded(static_cast<unsigned>(static_cast<int>(date.year())), 4) + '-' +
           two(static_cast<unsigned>(date.month())) + '-' + two(static_cast<unsigned>(date.day())) +
           'T' + two(clock.hours().count()) + ':' + two(clock.minutes().count()) + ':' +
           two(clock.seconds().count()) + '.' +
           padded(static_cast<unsigned>(clock.subseconds().count()), 3) + 'Z';
}

bool comesFromTimes(EventKind kind) {
    return kind == EventKind::Overflow || kind == EventKind::Watchdog;
}

// What to add to the monotonic clock to get UTC ns, at present.
std::int64_t utcOffset() {
    using namespace std::chrono;
    const auto utc = system_clock::now().time_since_epoch();
    return duration_cast<nanoseconds>(utc).count() - monotonicNow();
}

auto mergeKey(const Event& event) {
    return std::tie(event.cycle, event.order, event.sequence, event.number);
}

constexpr std::string_view ellipsis = "…";

// Behind the last whole word that fits, or in the middle of a long one.
std::size_t endOfCut(std::string_view text, std::size_t capacity) {
    constexpr std::size_t longWord = 40;
    const std::size_t fitting = fittingLength(text, capacity);
    const std::size_t blank = text.substr(0, fitting).rfind(' ');
    const bool isNear = blank != std::string_view::npos && fitting - blank <= longWord;
    return isNear ? blank + 1 : fitting;
}

using NumberBuffer = std::array<char, 32>;

template <class... Form>
std::string_view numberText(NumberBuffer& buffer, auto number, Form... form) {
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, form...).ptr;
    return {buffer.data(), static_cast<std::size_t>(end - buffer.data())};
}

std::string_view shortText(NumberBuffer& buffer, double number) {
    constexpr int digits = 6;
    if (number == std::trunc(number)) return numberText(buffer, number);
    return numberText(buffer, number, std::chars_format::general, digits);
}

}  // namespace

const char* name(EventKind kind) { return spelling(kind); }
std::optional<EventKind> eventKindFromName(std::string_view text) {
    return fromSpelling<EventKind>(text);
}

// Of a text that was cut the last octet is set, which is behind its end. Nothing comes after that.
EventText& EventText::operator<<(std::string_view text) {
    const bool isCut = length_ < text_.size() && text_.back() != 0;
    if (isCut) return *this;
    const std::size_t fitting = fittingLength(text, text_.size() - length_);
    if (fitting > 0) std::memcpy(text_.data() + length_, text.data(), fitting);
    length_ = static_cast<std::uint16_t>(length_ + fitting);
    if (fitting == text.size()) return *this;
    const std::size_t end = endOfCut(view(), text_.size() - 1 - ellipsis.size());
    std::memcpy(text_.data() + end, ellipsis.data(), ellipsis.size());
    length_ = static_cast<std::uint16_t>(end + ellipsis.size());
    text_.back() = '\1';
    return *this;
}

EventText& EventText::operator<<(const char* text) { return *this << std::string_view{text}; }

EventText& EventText::operator<<(std::int64_t number) {
    NumberBuffer buffer;
    return *this << numberText(buffer, number);
}

EventText& EventText::operator<<(double number) {
    NumberBuffer buffer;
    return *this << shortText(buffer, number);
}

EventText& EventText::apart(double number, double other) {
    NumberBuffer buffer, others;
    const std::string_view text = shortText(buffer, number);
    const bool alike = number != other && text == shortText(others, other);
    return *this << (alike ? numberText(buffer, number) : text);
}

// Three places for each order: before, in and after the tasks.
EventRing::EventRing(std::uint32_t capacity, std::size_t orders)
    : events_(std::bit_ceil(std::max<std::size_t>(capacity, 1))), lost_(3 * orders) {}

std::size_t EventRing::placeOf(const Event& event) const {
    const std::size_t phase = event.sequence < taskSequence  ? 0
                              : event.sequence < endSequence ? 1
                                                             : 2;
    return std::min<std::size_t>(3 * std::size_t{event.order} + phase, lost_.size() - 1);
}

// The number that a repeatable event has among those that are lost is known here already, but for
// what other simplexes lose in the same cycle.
void EventRing::post(const Event& event) {
    const bool repeats = !comesFromTimes(event.kind);
    std::uint32_t& lost = lost_[placeOf(event)];
    const std::size_t reserved = event.severity == Severity::Error ? 0 : events_.size() / 4;
    if (tail_ - head_.load(std::memory_order_acquire) >= events_.size() - reserved) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        if (!repeats) return;
        ++lost;
        hasLost_ = true;
        return;
    }
    Event& place = events_[tail_++ & (events_.size() - 1)];
    place = event;
    place.repeatable = repeats ? 1 + lostBefore_ + lost : 0;
}

void EventRing::countLost(std::span<const std::uint32_t> before, std::uint64_t all) {
    for (std::uint64_t i = visible_.load(std::memory_order_relaxed); i != tail_; ++i) {
        Event& event = events_[i & (events_.size() - 1)];
        if (event.repeatable != 0) event.repeatable += before[placeOf(event)];
    }
    lostBefore_ += all;
    hasLost_ = false;
}

bool EventRing::peek(Event& event) const {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head == visible_.load(std::memory_order_acquire)) return false;
    event = events_[head & (events_.size() - 1)];
    return true;
}

void EventRing::pop() {
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

EventLog::EventLog(std::shared_ptr<const Structure> structure, std::uint32_t rings,
                   std::uint32_t capacity)
    : structure_{std::move(structure)},
      fold_{std::make_unique<EventFold>(
          [this](const Event& event) {
              for (const Sink& sink : foldedSinks_) sink(event, *structure_);
          },
          [this](std::uint32_t simplex, std::string_view name) {
              if (simplex >= structure_->simplexes.size()) return false;
              const Command* command =
                  structure_->simplexes[simplex].layout->type->findCommand(name);
              return command != nullptr && command->repeated;
          })} {
    // Ranks of simplexes without a task follow those of the canonical order.
    const std::size_t orders = 2 * structure_->simplexes.size() + 1;
    for (std::uint32_t i = 0; i < rings; ++i) {
        rings_.push_back(std::make_unique<EventRing>(capacity, orders));
    }
    lostBefore_.resize(rings_.empty() ? 0 : rings_.front()->places());
}

EventLog::~EventLog() { stop(); }

void EventLog::addSink(Sink sink, Repeats repeats) {
    (repeats == Repeats::Folded ? foldedSinks_ : sinks_).push_back(std::move(sink));
}

void EventLog::start() {
    stopping_ = false;
    batch_.reserve(usualBatch);
    const ServiceThreads named{"cortex-events"};
    thread_ = std::thread{[this] { run(); }};
}

void EventLog::stop() {
    if (thread_.joinable()) {
        {
            const std::lock_guard lock{mutex_};
            stopping_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }
    complete(complete_.load(std::memory_order_acquire));
    handOut(std::numeric_limits<std::int64_t>::max());
    const std::lock_guard lock{merging_};
    fold_->pass(std::numeric_limits<std::int64_t>::max());
}

void EventLog::run() {
    std::unique_lock lock{mutex_};
    auto pause = shortestPause;
    while (!wake_.wait_for(lock, pause, [this] { return stopping_; })) {
        lock.unlock();
        const bool any = handOut(complete_.load(std::memory_order_acquire));
        pause = any ? shortestPause : std::min(2 * pause, longestPause);
        lock.lock();
    }
}

void EventLog::complete(std::int64_t cycle) {
    if (std::ranges::any_of(rings_, [](const auto& ring) { return ring->hasLost(); })) countLost();
    for (const auto& ring : rings_) ring->publish();
    complete_.store(cycle, std::memory_order_release);
}

void EventLog::countLost() {
    std::uint32_t all = 0;
    for (std::size_t place = 0; place < lostBefore_.size(); ++place) {
        lostBefore_[place] = all;
        for (const auto& ring : rings_) all += ring->takeLost(place);
    }
    for (const auto& ring : rings_) ring->countLost(lostBefore_, all);
}

void EventLog::postOutside(Event event) {
    if (event.clock == 0) event.clock = monotonicNow();
    const std::lock_guard lock{mutex_};
    outside_.push_back(event);
}

std::uint64_t EventLog::dropped() const {
    std::uint64_t sum = 0;
    for (const auto& ring : rings_) sum += ring->dropped();
    return sum;
}

void EventLog::flush() { handOut(complete_.load(std::memory_order_acquire)); }

bool EventLog::handOut(std::int64_t upTo) {
    const std::lock_guard lock{merging_};
    Event event;
    for (const auto& ring : rings_) {
        for (; ring->peek(event) && event.cycle <= upTo; ring->pop()) {
            event.number = batch_.size();  // for now: the order of the rings decides at last
            batch_.push_back(event);
        }
    }
    std::ranges::sort(batch_, {}, mergeKey);
    addDrops();
    {
        const std::lock_guard outsideLock{mutex_};
        std::swap(outside_, batchOutside_);
    }
    handOnInOrder();
    const bool any = !batch_.empty() || !batchOutside_.empty();
    if (!any) fold_->pass(monotonicNow());
    batch_.clear();
    batchOutside_.clear();
    return any;
}

// Those of the cycles keep their order. Those from outside come where their time is.
void EventLog::handOnInOrder() {
    const std::int64_t offset = utcOffset();
    auto outside = batchOutside_.begin();
    for (Event& each : batch_) {
        for (; outside != batchOutside_.end() && outside->clock < each.clock; ++outside)
            handOn(*outside, offset);
        handOn(each, offset);
    }
    for (; outside != batchOutside_.end(); ++outside) handOn(*outside, offset);
}

void EventLog::handOn(Event& event, std::int64_t offset) {
    event.wallClock =
        event.clock > 0 ? event.clock + offset : structure_->epoch * 1000 + event.time;
    event.number = ++number_;
    if (event.repeatable != 0) event.repeatable += repeatable_++;  // those lost before it count
    for (const Sink& sink : sinks_) sink(event, *structure_);
    if (!foldedSinks_.empty()) fold_->take(event, monotonicNow());
}

void EventLog::addDrops() {
    if (!batch_.empty()) {
        lastCycle_ = batch_.back().cycle;
        lastTime_ = batch_.back().time;
    }
    const std::uint64_t drops = dropped();
    if (drops == reportedDrops_) return;
    Event event;
    event.cycle = lastCycle_;
    event.time = lastTime_;
    event.clock = monotonicNow();
    event.severity = Severity::Warning;
    event.kind = EventKind::Loss;
    event.text << static_cast<std::int64_t>(drops - reportedDrops_)
               << " events dropped: more were posted than their ring holds";
    reportedDrops_ = drops;
    batch_.push_back(event);
}

std::string lineOf(const Event& event, const Structure& structure, std::int64_t wallClock) {
    const std::string path = event.simplex < structure.simplexes.size()
                                 ? structure.simplexes[event.simplex].path
                                 : "/" + structure.agent;
    return utcText(wallClock) + ' ' + name(event.severity) + ' ' + path + ' ' +
           printable(event.text.view());
}

}  // namespace cortex
