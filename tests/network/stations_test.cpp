// SPDX-License-Identifier: Apache-2.0
// Two stations, each a process, fight for one robot over real DDS; whoever holds it is killed.
#include "cortex/comms/dds_interface.hpp"
#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "network/processes.hpp"
#include "support/own_domain.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* counter = "/robot/counter";

comms::NetworkOptions loopback(const std::string& domain) {
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {"127.0.0.1"};
    return options;
}

// Who wrote, in order.
class Written {
public:
    void add(std::string_view name) {
        const std::lock_guard lock{mutex_};
        writers_.emplace_back(name);
    }
    std::vector<std::string> writers() const {
        const std::lock_guard lock{mutex_};
        return writers_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<std::string> writers_;
};

class ContestedCounter final : public cs::SimplexCS {
public:
    ContestedCounter(Identity identity, Written& written)
        : SimplexCS{std::move(identity)}, written_{written} {}

private:
    void populate() override { on<&ContestedCounter::increment>("increment"); }
    Outcome increment(Call& call) {
        if (call.sender() != nullptr) written_.add(call.sender()->nameText());
        return Outcome::Done;
    }

    Written& written_;
};

// A process that takes what it can get until it is killed.
class StationProcess {
public:
    explicit StationProcess(const std::string& domain) {
        std::string program = "/proc/self/exe", role = "station", number = domain;
        char* words[] = {program.data(), role.data(), number.data(), nullptr};
        process_ = fork();
        if (process_ < 0) throw std::runtime_error("cannot fork");
        if (process_ > 0) return;
        execv(program.c_str(), words);
        _exit(127);
    }
    ~StationProcess() { killIt(); }
    StationProcess(const StationProcess&) = delete;
    StationProcess& operator=(const StationProcess&) = delete;

    // A mirror appends host, process and a random part to its name.
    bool isNamed(const std::string& name) const {
        return name.find('.' + std::to_string(process_) + '-') != std::string::npos;
    }
    void killIt() {
        if (process_ == 0) return;
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
        process_ = 0;
    }

private:
    pid_t process_ = 0;
};

std::vector<std::string> withoutRepeats(std::vector<std::string> names) {
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

TEST(Stations, AreNeverTwoWritersWhoeverIsKilled) {
    constexpr int rounds = 5;
    const std::string domain = std::to_string(ownDomain());
    Written written;
    SimplexTree tree{
        TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} / "tests/data/network-rules.xml")};
    tree.add<ContestedCounter>(counter, "Counter", written);
    cs::ClusterCS robot{"robot", {.controlRequired = true}};
    robot.addSimplexTree(tree);
    robot.setTriggerSource<cs::InternalClock>(1ms);
    robot.addInterface<comms::DdsInterface>(loopback(domain));
    std::atomic<std::size_t> losses{0};
    robot.addEventSink([&losses](const Event& event, const Structure&) {
        const std::string_view text = event.text.view();
        if (text.find(" no longer has control of ") != text.npos) ++losses;
    });
    robot.start();
    comms::Mirror passerBy{"passer-by", loopback(domain)};
    ASSERT_TRUE(passerBy.waitForOwner(counter, 20s));
    std::map<int, StationProcess> stations;
    stations.try_emplace(0, domain);
    stations.try_emplace(1, domain);
    // Five writings of another than that one.
    const auto nextWriter = [&](const std::string& last) {
        for (const auto end = Clock::now() + 20s; Clock::now() < end;) {
            const auto writers = written.writers();
            const auto first = writers.empty() ? writers.end() : writers.end() - 1;
            if (first != writers.end() && *first != last &&
                std::ranges::count(writers, *first) >= 5) {
                return *first;
            }
            std::this_thread::sleep_for(1ms);
        }
        return std::string{};
    };
    std::string writer = nextWriter("");
    ASSERT_NE(writer, "");
    for (int round = 0; round < rounds; ++round) {
        const auto stopped = passerBy.call(counter, "shutdown");
        EXPECT_NE(stopped.reason, Reason::Authority) << stopped.why;
        EXPECT_EQ(
            passerBy.call(counter, "increment", {{"number", Value{std::vector<std::int64_t>{1}}}})
                .outcome,
            Outcome::Rejected);
        const auto holder = std::ranges::find_if(
            stations, [&](const auto& each) { return each.second.isNamed(writer); });
        ASSERT_NE(holder, stations.end()) << writer;
        stations.erase(holder);
        const auto killed = Clock::now();
        stations.try_emplace(round + 2, domain);
        const std::string next = nextWriter(writer);
        ASSERT_NE(next, "");
        std::cout
            << next << " writes "
            << std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - killed).count()
            << " ms after " << writer << " was killed\n";
        writer = next;
    }
    stations.clear();
    robot.stop();

    const std::size_t writers = withoutRepeats(written.writers()).size();
    EXPECT_GE(writers, std::size_t{rounds} + 1);
    EXPECT_LE(writers, losses + 1) << "somebody wrote while another held control";
}

}  // namespace

void runStation(const std::string& domain) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    comms::Mirror mirror{"station", loopback(domain)};
    mirror.waitForOwner(counter, 20s);
    const comms::Mirror::Arguments prefix{{"prefix", Value{std::vector<std::string>{counter}}}};
    for (;;) {
        std::this_thread::sleep_for(2ms);
        try {
            if (mirror.call("/robot", "takeControl", prefix).outcome != Outcome::Done) continue;
            mirror.call(counter, "startup");
            mirror.call(counter, "increment", {{"number", Value{std::vector<std::int64_t>{1}}}});
        } catch (const Error&) {  // the robot is not known yet
        }
    }
}

}  // namespace cortex::test
