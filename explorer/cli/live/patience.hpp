// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace cortex::cli {

// How long a verb waits. Where nobody has said how long, whatever comes gives time for the next,
// and so does each participant that was found and has not said who it is: agents that join take
// longer the more they are.
class Patience {
public:
    using Milliseconds = std::chrono::milliseconds;
    using Moment = std::chrono::steady_clock::time_point;
    static constexpr Milliseconds longest{30'000};     // that nobody asked for
    static constexpr Milliseconds forNameless{500};    // each
    static constexpr std::uint32_t mostNameless = 20;  // strangers may be many

    Patience(Milliseconds time, bool grows, Moment now)
        : time_{time}, grows_{grows}, begin_{now}, end_{now + time} {}

    // So much is known now, of which only what is new counts, and of so many nothing.
    void know(std::uint64_t known, std::uint32_t nameless, Moment now) {
        if (!grows_) return;
        Moment end = begin_ + time_ + std::min(nameless, mostNameless) * forNameless;
        if (known > known_) end = std::max(end, now + time_);
        known_ = std::max(known_, known);
        end_ = std::max(end_, std::min(end, begin_ + longest));
    }
    bool grows() const { return grows_; }        // nobody has said how long
    Milliseconds time() const { return time_; }  // without what has come
    Milliseconds whole() const {                 // from the start, in tenths of a second
        constexpr Milliseconds tenth{100};
        const auto all = std::chrono::duration_cast<Milliseconds>(end_ - begin_);
        return all <= time_ ? time_ : all / tenth * tenth;
    }
    bool over(Moment now) const { return now >= end_; }
    Milliseconds left(Moment now) const {  // 1 ms when it is over
        return std::max(std::chrono::duration_cast<Milliseconds>(end_ - now), Milliseconds{1});
    }

private:
    Milliseconds time_;
    bool grows_;
    Moment begin_, end_;
    std::uint64_t known_ = 0;
};

}  // namespace cortex::cli
