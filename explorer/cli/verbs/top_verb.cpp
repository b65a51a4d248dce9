// SPDX-License-Identifier: Apache-2.0
#include "common/past_events.hpp"
#include "live/live_events.hpp"
#include "live/live_json.hpp"
#include "live/live_values.hpp"
#include "live/top_text.hpp"
#include "text/terminal.hpp"
#include "verbs/live_verbs.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace cortex::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr std::size_t eventsKept = 200, eventsAsText = 10;
constexpr Milliseconds longestWait{200};  // until it is seen that nobody is left

// Where frames go: a terminal's screen, lines of JSON, or text one after the other.
class Frames {
public:
    Frames(const TopOptions& options, std::string title)
        : options_{options}, title_{std::move(title)} {
        if (!options.json && !options.once && Screen::possible()) screen_.emplace();
    }

    bool onScreen() const { return screen_.has_value(); }
    bool hasKeys() const { return screen_ && screen_->hasKeys(); }
    Milliseconds period() const {
        const double rate = options_.rate   ? *options_.rate
                            : onScreen()    ? 2
                            : options_.json ? 1
                                            : 0.2;
        return Milliseconds{std::llround(1000 / rate)};
    }
    void show(const TopFrame& frame) const {
        if (options_.json) return printLine(topJson(frame));
        if (onScreen())
            return Screen::show(
                text(frame, Screen::rows(), head(frame, hasKeys() ? "q ends" : "")));
        print(frame);
    }
    // Leaves a frame behind when the screen is gone.
    void end(const TopFrame& frame) {
        if (!onScreen()) return show(frame);
        screen_.reset();
        print(frame);
    }
    void close() { screen_.reset(); }

private:
    void print(const TopFrame& frame) const {
        TopFrame last = frame;
        const std::size_t events = std::min(last.events.size(), eventsAsText);
        last.events.erase(last.events.begin(), last.events.end() - static_cast<long>(events));
        std::cout << text(last, anyWidth, head(frame, "")) << "\n" << std::endl;
    }
    std::string text(const TopFrame& frame, std::size_t rows, const std::string& head) const {
        const bool terminal = Screen::possible();
        const std::size_t width = terminal ? Screen::columns() : anyWidth;
        std::string result;
        for (const TextLine& each : topLines(frame, head, width, rows)) {
            if (!result.empty()) result += '\n';
            result += rendered(each, width, coloured(Stream::Output));
        }
        return result;
    }
    std::string head(const TopFrame& frame, const std::string& hint) const {
        std::size_t lost = 0, incomplete = 0;
        for (const TopAgent& each : frame.agents) {
            lost += each.status.state == "lost" ? 1 : 0;
            incomplete += each.status.state == "incomplete" ? 1 : 0;
        }
        std::string text = title_ + "  " + common::utcText(frame.time).substr(11, 8) + "Z  ";
        text += frame.agents.empty() ? "no agent" : plural(frame.agents.size(), "agent");
        if (incomplete > 0) text += ", " + std::to_string(incomplete) + " incomplete";
        if (lost > 0) text += ", " + std::to_string(lost) + " lost";
        return text + (hint.empty() ? "" : "  (" + hint + ")");
    }

    const TopOptions& options_;
    std::string title_;
    std::optional<Screen> screen_;
};

// The newest events, in order of time.
class Events {
public:
    void take(Arrivals& arrivals, const TopView& view) {
        for (comms::AgentEvent& each : arrivals.take(Milliseconds{0})) {
            if (each.path.empty() || view.shows(each.path)) events_.push_back(std::move(each));
        }
        common::sortByTime(events_);
        if (events_.size() > eventsKept) {
            events_.erase(events_.begin(), events_.end() - static_cast<long>(eventsKept));
        }
    }
    // What is to be shown: for people the newest again, for programs each once.
    std::vector<comms::AgentEvent> shown(bool once) {
        return once ? std::exchange(events_, {}) : events_;
    }

private:
    std::vector<comms::AgentEvent> events_;
};

class Top {
public:
    Top(const TopOptions& options, Signals& signals)
        : options_{options},
          signals_{signals},
          live_{options.network},
          view_{live_, options.prefix, options.rate && *options.rate > 5 ? 30U : 5U} {
        live_.listen([this](const comms::AgentEvent& event) { arrivals_.push(event); });
    }

    Exit run() {
        const std::string below = options_.prefix == "/" ? "" : "  " + options_.prefix;
        Frames frames{options_, "cortex top  domain " + std::to_string(live_.domain()) + below};
        if (!frames.onScreen() && !waitForSomething()) return end(frames, false);
        const Clock::time_point begin = Clock::now();
        Clock::time_point next = begin;
        for (;;) {
            if (Clock::now() >= next) {
                look();
                if (seen_ || frames.onScreen()) frames.show(last_);
                next = std::max(next + frames.period(), Clock::now());
            }
            if (options_.once) return end(frames, false);
            const Clock::time_point limit =
                options_.seconds ? begin + Milliseconds{std::llround(*options_.seconds * 1000)}
                                 : Clock::time_point::max();
            const Woken woken = wait(std::min(next, limit), frames.hasKeys());
            if (woken == Woken::BySignal || (woken == Woken::ByKey && wantsEnd(signals_.key()))) {
                return end(frames, frames.onScreen());
            }
            if (woken == Woken::BySize) next = Clock::now();
            if (Clock::now() >= limit || nobodyIsLeft() || !std::cout) return end(frames, false);
        }
    }

private:
    // What stays is the last moment with agents.
    Exit end(Frames& frames, bool byUser) {
        if (byUser || (options_.once && seen_)) {
            frames.close();
            return Yes;
        }
        if (!seen_) {
            frames.close();
            live_.failWithNobody();
        }
        if (options_.json) return Yes;
        look();
        if (!last_.anyAgent()) {
            alive_.events = last_.events;
            last_ = alive_;
        }
        frames.end(last_);
        return Yes;
    }
    static bool wantsEnd(char key) { return key == 'q' || key == 'Q' || key == '\003'; }

    void look() {
        TopFrame frame = view_.frame();
        events_.take(arrivals_, view_);
        frame.events = events_.shown(options_.json);
        if (frame.anyAgent()) alive_ = frame;
        last_ = std::move(frame);
        seen_ = seen_ || last_.anyAgent();
    }
    // So that the first frame that is printed has everything. False: a signal came.
    bool waitForSomething() {
        const auto quiet = [&] { return signals_.wait(Milliseconds{0}, false) != Woken::BySignal; };
        const Milliseconds slice{100};
        bool complete = false;
        while (!complete && live_.left() > slice) {
            complete = live_.mirror().waitUntilComplete(slice);
            if (!quiet()) return false;
        }
        view_.frame();
        while (!live_.mirror().waitForValues(slice) && live_.left() > slice) {
            if (!quiet()) return false;
        }
        return true;
    }
    Woken wait(Clock::time_point end, bool keys) {
        const auto left = std::chrono::ceil<Milliseconds>(end - Clock::now());
        return signals_.wait(std::clamp(left, Milliseconds{0}, longestWait), keys);
    }
    bool nobodyIsLeft() {
        if (!options_.untilGone || !seen_) return false;
        TopFrame frame = view_.frame();
        if (!frame.anyAgent()) return true;
        alive_ = std::move(frame);
        return false;
    }

    const TopOptions& options_;
    Signals& signals_;
    Arrivals arrivals_;
    Live live_;
    TopView view_;
    Events events_;
    TopFrame last_, alive_;  // the last, and the last with an agent
    bool seen_ = false;
};

}  // namespace

Exit showTop(const TopOptions& options) {
    checkPrefix(options.prefix);
    Signals signals;
    return Top{options, signals}.run();
}

}  // namespace cortex::cli
