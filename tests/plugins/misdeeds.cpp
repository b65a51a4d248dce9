// SPDX-License-Identifier: Apache-2.0
// A plug-in whose hooks do what no hook may do, each something else.
#include "cortex/core/registry.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stdexcept>

#include <sys/mman.h>
#include <unistd.h>

namespace {

using cortex::Tick;

std::mutex mutex;
void* volatile kept = nullptr;
volatile int shared = 0;

class Misdeeds final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        pages_ = static_cast<char*>(mmap(nullptr, mostPages * pageSize, PROT_READ | PROT_WRITE,
                                         MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    }
    void loopStart(const Tick&) override {
        kept = std::malloc(24);  // the allocation
        std::free(kept);         // the release
    }
    void stateStandby(const Tick&) override {
        const std::lock_guard lock{mutex};  // the lock
        shared = shared + 1;
    }
    bool stateStartingUp(const Tick&) override {
        close(-1);  // the system call
        return true;
    }
    void stateActive(const Tick&) override {
        std::printf("from a hook\n");  // the output
    }
    void loopEnd(const Tick&) override {
        if (page_ == mostPages) return;
        pages_[page_ * pageSize] = 1;  // the page fault
        ++page_;
    }

    static constexpr std::size_t mostPages = 64, pageSize = 4096;
    char* pages_ = nullptr;
    std::size_t page_ = 0;
};

class Thrower final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void stateActive(const Tick&) override {
        throw std::logic_error("it was asked to");  // the throw
    }
};

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<Misdeeds>("Misdeeds");
    registry.add<Thrower>("Thrower");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"Misdeeds", ""}, {"Thrower", ""})
