// SPDX-License-Identifier: Apache-2.0
// The example of a device behind a port: its plug-in talks over a pseudo-terminal to the simulated
// oven, which is a process of its own.
#include "cortex/core/registry.hpp"
#include "cortex/core/simplex_tree.hpp"
#include "cortex/cs/cluster_cs.hpp"

#include "core/model_folder.hpp"
#include "support/waiting.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace cortex::test {
namespace {

using namespace std::chrono_literals;

class OvenProcess {
public:
    explicit OvenProcess(std::string port) : port_{std::move(port)} {
        char* arguments[] = {const_cast<char*>("simulated_oven"), port_.data(), nullptr};
        posix_spawn(&process_, CORTEX_OVEN, nullptr, nullptr, arguments, environ);
    }
    ~OvenProcess() {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    OvenProcess(const OvenProcess&) = delete;
    OvenProcess& operator=(const OvenProcess&) = delete;

    void signal(int number) const { kill(process_, number); }

private:
    std::string port_;
    pid_t process_ = -1;
};

class Bakery : public testing::Test {
protected:
    static std::string file(const std::string& name) {
        return CORTEX_SOURCE_DIR "/examples/e04_device/" + name;
    }
    SimplexTree load() {
        registry.loadPlugin(CORTEX_OVEN_PLUGIN, TypeModel::load(file("oven-rules.xml")));
        return SimplexTree::load(file("oven.xml"), &registry);
    }
    void SetUp() override {
        tree.at("/oven").set("address", port());
        bakery.addSimplexTree(tree);
        bakery.setTriggerSource<cs::InternalClock>(10ms);
        bakery.addEventSink([this](const Event& event, const Structure&) {
            const std::lock_guard lock{mutex};
            events += std::string{event.text.view()} + "\n";
        });
        bakery.start();
    }
    void TearDown() override { bakery.stop(); }
    std::string port() const { return (folder.path() / "oven").string(); }
    double value(const std::string& path, const std::string& item) {
        return bakery.image().get<double>(path, item);
    }
    Quality quality() {
        const Image image = bakery.image();
        return image.state(image.structure().find("/inside")).quality;
    }
    void waitForEvent(const std::string& text) {
        const auto seen = [this] {
            const std::lock_guard lock{mutex};
            return events;
        };
        waitUntil("'" + text + "'", [&] { return contains(seen(), text); }, seen);
    }

    ClassRegistry registry;
    SimplexTree tree = load();
    ModelFolder folder;
    std::mutex mutex;
    std::string events;
    cs::ClusterCS bakery{"bakery"};
};

TEST_F(Bakery, HeatsThroughTheLineWhenItsControllerIsActive) {
    const OvenProcess oven{port()};
    waitUntil("a good value", [&] { return quality() == Quality::Good; });
    EXPECT_NEAR(value("/inside", "temperature"), 20, 0.01);

    bakery.call("/controller", "startup");

    waitUntil("an oven that is warm", [&] { return value("/inside", "temperature") > 21; });
    waitUntil("a heater that is on", [&] { return value("/heater", "power") > 1500; });
}

TEST_F(Bakery, SaysThatTheOvenIsGoneHeatsNoMoreAndConnectsAnew) {
    {
        const OvenProcess oven{port()};
        waitUntil("a good value", [&] { return quality() == Quality::Good; });
        bakery.call("/controller", "startup");
        waitUntil("an oven that gets warm", [&] { return value("/inside", "temperature") > 20.5; });
    }
    waitUntil("a lost value", [&] { return quality() == Quality::Lost; });
    waitUntil("a heater that is off", [&] { return value("/heater", "power") == 0; });
    waitForEvent("the device is lost: " + port());
    EXPECT_GT(value("/inside", "temperature"), 20.5) << "the last one, known to be lost";

    const OvenProcess another{port()};
    waitUntil("a good value", [&] { return quality() == Quality::Good; });
    waitForEvent("the device is back");
    waitUntil("a heater that is on", [&] { return value("/heater", "power") > 1500; });
}

TEST_F(Bakery, SaysThatTheOvenDoesNotAnswerAndGoesOnWhenItDoes) {
    const OvenProcess oven{port()};
    waitUntil("a good value", [&] { return quality() == Quality::Good; });

    oven.signal(SIGSTOP);
    waitUntil("a lost value", [&] { return quality() == Quality::Lost; });
    waitForEvent("the device is lost: " + port() + ": no answer for 200 ms; is the oven on?");
    oven.signal(SIGCONT);

    waitUntil("a good value", [&] { return quality() == Quality::Good; });
    waitForEvent("the device is back");
}

TEST_F(Bakery, WithoutAnOvenSaysWhichPortIsMissingAndDoesNotFault) {
    waitForEvent("the device is lost: " + port() + ": No such file");

    EXPECT_EQ(bakery.image().get<std::int64_t>("/oven", "state"), 0);
    EXPECT_EQ(quality(), Quality::Lost);
}

}  // namespace
}  // namespace cortex::test
