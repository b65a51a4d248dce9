// SPDX-License-Identifier: Apache-2.0
#include "tasks/slow_job.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace cortex::cs {

namespace {

using Job = SlowWork::Job;

// Runs from the first job to the last.
class SlowThread {
public:
    static SlowThread& ofProcess() {
        static SlowThread thread;
        return thread;
    }
    void add(const std::shared_ptr<Job>& job) {
        const std::scoped_lock lock{mutex_};
        jobs_.push_back(job);
        if (!thread_.joinable()) thread_ = std::thread{[this] { run(); }};
    }
    void remove(const std::shared_ptr<Job>& job) {
        std::thread ended;
        {
            std::unique_lock lock{mutex_};
            changed_.wait(lock, [&] { return running_ != job; });
            std::erase(jobs_, job);
            if (jobs_.empty()) ended = std::exchange(thread_, std::thread{});
        }
        changed_.notify_all();
        if (ended.joinable()) ended.join();
    }

private:
    // The loop only sets a word, as to wake a thread is a system call; so this looks by itself.
    void run() {
        std::unique_lock lock{mutex_};
        const std::thread::id own = std::this_thread::get_id();
        while (thread_.get_id() == own) {
            while (runOne(lock)) {
            }
            changed_.wait_for(lock, std::chrono::milliseconds{5});
        }
    }
    bool runOne(std::unique_lock<std::mutex>& lock) {
        const auto asked = std::ranges::find_if(
            jobs_, [](const std::shared_ptr<Job>& job) { return job->isAsked(); });
        if (asked == jobs_.end()) return false;
        running_ = *asked;
        lock.unlock();
        running_->run();
        lock.lock();
        running_.reset();
        changed_.notify_all();
        return true;
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::shared_ptr<Job>> jobs_;
    std::shared_ptr<Job> running_;
    std::thread thread_;
};

}  // namespace

SlowWork::SlowWork(std::function<void()> work) : job_{std::make_shared<Job>()} {
    job_->work = std::move(work);
    SlowThread::ofProcess().add(job_);
}

SlowWork::SlowWork(SlowWork&& other) noexcept = default;

SlowWork& SlowWork::operator=(SlowWork&& other) noexcept {
    std::swap(job_, other.job_);
    return *this;
}

SlowWork::SlowWork(std::shared_ptr<Job> job) : job_{std::move(job)} {}

SlowWork::~SlowWork() {
    if (job_ && !job_->isOfDevice) SlowThread::ofProcess().remove(job_);
}

bool SlowWork::begin() {
    if (!job_ || isRunning()) return false;
    job_->state.store(Job::State::Asked, std::memory_order_release);
    return true;
}

bool SlowWork::isRunning() const {
    return job_ && job_->state.load(std::memory_order_acquire) != Job::State::Rests;
}

std::string_view SlowWork::failure() const {
    if (!job_) return {};
    return {job_->failure.data(), job_->failureLength};
}

}  // namespace cortex::cs
