// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "cli/live_agent.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cortex::test {

// While patience lasts.
bool becomesTrue(const std::function<bool()>& condition, const Place& place = Place::current());

comms::NetworkOptions ownNetwork();  // that of this test

// `cortex` on it.
std::vector<std::string> cortexCommand(const std::vector<std::string>& arguments);

// Who holds what, by `cortex leases`.
nlohmann::json leases();
bool leasesShow(const std::string& prefix, const Place& place = Place::current());  // in the end
bool hasEvent(const std::string& text);
std::int64_t cycleOfAgent();

// Somebody else, who takes a lease and renews it until the end.
class Holder {
public:
    explicit Holder(const std::string& prefix);
    ~Holder();
    Holder(const Holder&) = delete;
    Holder& operator=(const Holder&) = delete;

    const std::string& name() const { return mirror_.name(); }
    comms::CommandAnswer ask(const std::string& command, const std::string& to = "");

private:
    std::string prefix_;
    comms::Mirror mirror_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool stopping_ = false;
    std::thread thread_;
};

// An agent that only those may command who hold a lease. Its controller can move for minutes.
class CortexControl : public testing::Test {
protected:
    CortexControl();
    void start();

    const ModelFolder folder;
    std::string file;
    std::optional<Background> agent;
};

}  // namespace cortex::test
