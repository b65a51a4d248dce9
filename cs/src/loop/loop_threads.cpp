// SPDX-License-Identifier: Apache-2.0
#include "loop/cluster_loop.hpp"
#include "tasks/crash_report.hpp"
#include "threads/realtime_thread.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace cortex::cs {

void ClusterLoop::addThreads(Plan& plan) {
    PoolOptions pool;
    pool.name = agent_.name();
    pool.priority = options_.priority;
    pool.affinity = options_.cpus;
    pool.pin = pin_;
    pool.oversubscribe = test_.forceThreads;
    pool.onStart = [](void* loop, std::uint32_t worker) {
        static_cast<ClusterLoop*>(loop)->threadStarts(worker);
    };
    pool.onStartContext = this;
    plan.pool = std::make_unique<ThreadPool>(
        plan.schedule,
        [](void* loop, std::uint32_t chunk, std::uint32_t worker) {
            static_cast<ClusterLoop*>(loop)->runner_.run(chunk, worker);
        },
        this, pool);
    for (const int cpu : plan.pool->pinnedTo()) {
        plan.cpus += (plan.cpus.empty() ? "" : " ") + std::to_string(cpu);
    }
}

// The loops of a host do not share a CPU by accident. Where none is left, the system places the
// threads. Whoever names CPUs knows them.
void ClusterLoop::claimCpus() {
    const bool wouldPin = options_.priority > 0 || options_.threads > 1;
    if (!options_.cpus.empty() || test_.forceThreads || !wouldPin) return;
    const std::size_t wanted = std::min<std::size_t>(options_.threads, usableCpus().size());
    options_.cpus = claims_.take(usableCpus(), wanted);
    pin_ = !options_.cpus.empty();
    if (pin_) return;
    realtimeReport_.push_back(
        "Its threads are not pinned, as other loops of this host have claimed their CPUs: too few "
        "are left of " +
        std::to_string(usableCpus().size()) +
        ". Name CPUs in 'cpus', or run fewer loops with a priority or several threads.");
}

void ClusterLoop::prepareThread() {
    const auto append = [this](const std::vector<std::string>& lines) {
        realtimeReport_.insert(realtimeReport_.end(), lines.begin(), lines.end());
    };
    claimCpus();
    addThreads(*plan_);
    metrics_.cpus(plan_->cpus);
    threads_.store(plan_->pool->threads(), std::memory_order_relaxed);
    append(plan_->pool->report());
    append(plan_->pool->configureLoopThread());
    if (options_.priority > 0 && options_.lockMemory) append(lockMemory());
    if (options_.priority > 0 && options_.keepCpusAwake) awakeCpus_.emplace(realtimeReport_);
    threadStarts(0);
}

// On each thread that runs tasks, before its first cycle.
void ClusterLoop::threadStarts(std::uint32_t worker) {
    reportCrashesOfThisThread(agent_.structure(), runner_.position(worker), runner_.escape(worker));
    if (test_.onThreadStart) test_.onThreadStart(worker);
}

}  // namespace cortex::cs
