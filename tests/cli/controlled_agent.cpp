// SPDX-License-Identifier: Apache-2.0
#include "cli/controlled_agent.hpp"

#include <chrono>

namespace cortex::test {

comms::NetworkOptions ownNetwork() {
    comms::NetworkOptions options;
    options.domain = std::stoi(domain);
    options.interfaces = {"127.0.0.1"};
    return options;
}

bool becomesTrue(const std::function<bool()>& condition, const Place& place) {
    return looksUntil(condition, std::this_thread::yield, place);
}

std::vector<std::string> cortexCommand(const std::vector<std::string>& arguments) {
    return std::vector<std::string>{CORTEX_BINARY_DIR "/bin/cortex"} + arguments + network;
}

nlohmann::json leases() { return liveJson({"leases"}, "leases"); }

bool leasesShow(const std::string& prefix, const Place& place) {
    return becomesTrue(
        [&] {
            const nlohmann::json shown = leases();
            return shown.size() == 1 && shown[0]["prefix"] == prefix;
        },
        place);
}

bool hasEvent(const std::string& text) { return contains(live({"events"}).output, text); }

std::int64_t cycleOfAgent() { return liveJson({"agents"}, "agents")[0]["cycle"]; }

Holder::Holder(const std::string& prefix) : prefix_{prefix}, mirror_{"desk", ownNetwork()} {
    mirror_.waitForOwner("/mixer", patience);
    const comms::CommandAnswer answer = ask("takeControl");
    EXPECT_TRUE(answer.done()) << answer.text();
    thread_ = std::thread{[this] {
        std::unique_lock lock{mutex_};
        while (!changed_.wait_for(lock, std::chrono::milliseconds{300},
                                  [this] { return stopping_; })) {
            ask("renewControl");
        }
    }};
}

Holder::~Holder() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

comms::CommandAnswer Holder::ask(const std::string& command, const std::string& to) {
    comms::Mirror::Arguments arguments{{"prefix", prefix_}};
    if (!to.empty()) arguments["to"] = std::vector<std::string>{to};
    return mirror_.call("/mixer", command, arguments, patience);
}

CortexControl::CortexControl() {
    std::string system = mixerSystem(20);  // inputs are lost after three cycles
    replace(system, "<cluster name=\"mixer\"", "<cluster name=\"mixer\" control=\"required\"");
    replace(system, "\"HoldAxisController\"", "\"AxisPoseController\"");
    file = folder.write("mixer.xml", system).string();
    start();
}

void CortexControl::start() { agent.emplace(agentCommand(file)); }

}  // namespace cortex::test
