// SPDX-License-Identifier: Apache-2.0
#include "conform/recording.hpp"

#include "text/interrupts.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace cortex::cli::conform {

// It lives for as long as the mirror has its listener, and does nothing once it is closed.
struct Recording::Shared {
    explicit Shared(const Plant& whole)
        : plant{&whole},
          layout{std::make_shared<const SampleLayout>(*whole.structure, whole.followed())},
          honesty{whole} {}

    void take(const std::string& agent, const comms::AgentImage& image) {
        const std::scoped_lock lock{mutex};
        if (plant == nullptr || agent != plant->agent || !image || image.lost()) return;
        if (&image->structure() != plant->structure.get()) {
            restarted = true;
            changed.notify_all();
            return;
        }
        if (latest && image->cycle() <= latest->cycle) return;
        const auto came = [&](const auto& part) { return image.came(part.simplex); };
        if (!std::ranges::all_of(layout->parts, came)) return;
        latest.emplace(layout, *image);
        honesty.take(*latest);
        if (each) each(*latest);
        changed.notify_all();
    }

    std::mutex mutex;
    std::condition_variable changed;
    const Plant* plant;
    std::shared_ptr<const SampleLayout> layout;
    Honesty honesty;
    std::optional<Sample> latest;
    std::function<void(const Sample&)> each;
    bool restarted = false;
};

Recording::Recording(Live& live, const Plant& plant)
    : live_{live}, shared_{std::make_shared<Shared>(plant)} {
    std::vector<std::string> paths;
    for (const std::uint32_t each : plant.followed()) paths.push_back(plant.path(each));
    live.mirror().onImage(
        [shared = shared_](const std::string& agent, const comms::AgentImage& image) {
            shared->take(agent, image);
        });
    live.view(std::move(paths), 0);
    waitForNext(-1);
}

Recording::~Recording() {
    const std::scoped_lock lock{shared_->mutex};
    shared_->plant = nullptr;
}

Sample Recording::latest() const {
    const std::scoped_lock lock{shared_->mutex};
    return *shared_->latest;
}

void Recording::waitForNext(std::int64_t after) const {
    const auto end = std::chrono::steady_clock::now() + live_.timeout();
    std::unique_lock lock{shared_->mutex};
    const auto isThere = [&] {
        return shared_->restarted || (shared_->latest && shared_->latest->cycle > after);
    };
    while (!shared_->changed.wait_for(lock, interruptSlice, isThere)) {
        if (isInterruptible_) throwIfInterrupted();
        if (std::chrono::steady_clock::now() < end) continue;
        throw Failure{NotFound, "agent " + shared_->plant->agent + " sent no cycle for " +
                                    live_.limitText() +
                                    "; look with 'cortex agents' whether it "
                                    "runs, or wait longer (--timeout)"};
    }
    if (shared_->restarted)
        throw Failure{NotFound, "agent " + shared_->plant->agent + " was started anew meanwhile"};
    if (isInterruptible_) throwIfInterrupted();
}

bool Recording::becomes(const std::function<bool(const Sample&)>& condition, double seconds) const {
    Sample now = latest();
    const double end = now.seconds() + seconds;
    while (!condition(now)) {
        if (now.seconds() >= end) return false;
        waitForNext(now.cycle);
        now = latest();
    }
    return true;
}

void Recording::pass(double seconds) const {
    becomes([](const Sample&) { return false; }, seconds);
}

void Recording::follow(std::function<void(const Sample&)> each) {
    const std::scoped_lock lock{shared_->mutex};
    shared_->each = std::move(each);
}

Honesty Recording::honesty() const {
    const std::scoped_lock lock{shared_->mutex};
    return shared_->honesty;
}

}  // namespace cortex::cli::conform
