// SPDX-License-Identifier: Apache-2.0
#include "network/hand_and_robot.hpp"

#include "cortex/comms/dds_interface.hpp"

#include "network/processes.hpp"

#include <algorithm>
#include <csignal>
#include <limits>
#include <stdexcept>
#include <utility>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::test {

struct RobotProcess::Memory {
    std::atomic<std::int64_t> newest;
    std::atomic<std::int64_t> origin;  // of the robot's time
    std::atomic<int> presses;
    Record<Seen> seen;
    Record<Executed> executed;
};

namespace {

using namespace std::chrono_literals;
constexpr auto budget = 500ms;

TypeModel types() {
    return TypeModel::load(std::filesystem::path{CORTEX_SOURCE_DIR} /
                           "tests/data/network-rules.xml");
}

class Finger final : public cs::SimplexCS {
public:
    Finger(Identity identity, HandAgent::Recorded& record)
        : SimplexCS{std::move(identity)}, record_{record} {}

private:
    void populate() override {
        const OutputSimplex button = output("button");
        pressed_ = button.data<bool>("pressed");
        press_ = button.data<std::int64_t>("press");
        written_ = button.data<std::int64_t>("written");
    }
    void stateActive(const Tick& tick) override {
        const auto now = Clock::now();
        written_ = tick.cycle;
        record_.written.add({tick.cycle, now});
        if (tick.cycle < next_) return;
        if (pressed_) {
            record_.presses.add({tick.cycle, now});
        } else {
            press_ = press_ + 1;
        }
        pressed_ = !pressed_;
        next_ = tick.cycle + 20 + press_ * 37 % 130;
    }

    HandAgent::Recorded& record_;
    std::int64_t next_ = 0;
    Data<bool> pressed_;
    Data<std::int64_t> press_, written_;
};

// Sends in every state, each time when the answer to the one before is here.
class Chief final : public cs::SimplexCS {
public:
    Chief(Identity identity, HandAgent::Recorded& record)
        : SimplexCS{std::move(identity)}, record_{record} {}

private:
    void populate() override {
        increment_ = input("counter").command("increment");
        number_ = increment_.argument<std::int64_t>("number");
        number_ = HandAgent::firstOrder;
    }
    void loopEnd(const Tick& tick) override {
        if (increment_.sent() != increment_.answered()) return;
        if (record_.waiting) {
            record_.ordered.add({number_, increment_.answer().outcome});
            record_.waiting = false;
        }
        if (!record_.orders || tick.cycle % 10 != 0) return;
        number_ = number_ + 1;
        increment_.send();
        record_.waiting = true;
    }

    HandAgent::Recorded& record_;
    CommandSender increment_;
    Data<std::int64_t> number_;
};

class Watcher final : public cs::SimplexCS {
public:
    Watcher(Identity identity, RobotProcess::Memory& memory)
        : SimplexCS{std::move(identity)}, memory_{memory} {}

private:
    void populate() override {
        const InputSimplex button = input("button");
        pressed_ = button.data<bool>("pressed");
        press_ = button.data<std::int64_t>("press");
        written_ = button.data<std::int64_t>("written");
    }
    void stateActive(const Tick& tick) override {
        // Whatever stops this thread between its wake-up and here: the quickest tell the truth.
        const std::int64_t at = tick.nominalTime + tick.lateness;
        memory_.origin =
            std::min<std::int64_t>(memory_.origin, Clock::now().time_since_epoch().count() - at);
        if (first_ == 0) first_ = written_;
        if (written_ != last_) {
            last_ = written_;
            came_ = at;
        }
        // How long the first ones took nobody knows.
        if (!pressed_ || written_ < first_ + 500) return;
        memory_.seen.add({press_, written_, came_, at});
        if (std::exchange(lastPress_, std::int64_t{press_}) != press_) ++memory_.presses;
    }

    RobotProcess::Memory& memory_;
    std::int64_t first_ = 0, last_ = 0, came_ = 0, lastPress_ = 0;
    Data<const bool> pressed_;
    Data<const std::int64_t> press_, written_;
};

class Counter final : public cs::SimplexCS {
public:
    Counter(Identity identity, Record<Executed>& executed)
        : SimplexCS{std::move(identity)}, executed_{executed} {}

private:
    void populate() override {
        count_ = data<std::int64_t>("count");
        number_ = argument<std::int64_t>("increment", "number");
        on<&Counter::increment>("increment");
    }
    // Commands are executed before the hooks of their cycle.
    void loopEnd(const Tick& tick) override { cycle_ = tick.cycle; }
    Outcome increment(Call& call) {
        executed_.add({call[number_], cycle_ + 1});
        count_ = count_ + 1;
        return Outcome::Done;
    }

    Record<Executed>& executed_;
    std::int64_t cycle_ = 0;
    Data<std::int64_t> count_;
    Argument<std::int64_t> number_;
};

CallResult startUp(cs::ClusterCS& cluster, const std::string& name) {
    return cluster.call("/" + name, "startup", {{"prefix", Value{std::vector<std::string>{"/"}}}});
}

void start(cs::ClusterCS& cluster, SimplexTree& tree, const comms::NetworkOptions& network) {
    cluster.addSimplexTree(tree);
    cluster.setTriggerSource<cs::InternalClock>(1ms);
    cluster.addInterface<comms::DdsInterface>(network);
    cluster.start();
}

}  // namespace

comms::NetworkOptions network(const std::string& peer, const std::string& security) {
    comms::NetworkOptions options;
    options.domain = 7;
    if (!peer.empty()) options.peers = {peer};
    options.security = security;
    return options;
}

HandAgent::HandAgent(const comms::NetworkOptions& network) : tree_{types()}, cluster_{"hand"} {
    Simplex& button = tree_.add("/hand/button", "Button");
    tree_.relate(tree_.add<Finger>("/hand/finger", "Finger", *record_), "button", button);
    tree_.relateRemote(tree_.add<Chief>("/hand/chief", "Chief", *record_), "counter",
                       "/robot/counter");
    start(cluster_, tree_, network);
    startUp(cluster_, "hand");
}

HandAgent::~HandAgent() = default;

void HandAgent::endOrders() {
    record_->orders = false;
    for (const auto end = Clock::now() + 20s; record_->waiting && Clock::now() < end;) {
        std::this_thread::sleep_for(1ms);
    }
}

void HandAgent::end() { cluster_.stop(); }

namespace {

RobotProcess::Memory* shared(int file) {
    void* memory =
        mmap(nullptr, sizeof(RobotProcess::Memory), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
    return static_cast<RobotProcess::Memory*>(memory);
}

}  // namespace

void runRobot(int file, const std::string& peer, const std::string& security) {
    RobotProcess::Memory& memory = *shared(file);
    const pid_t parent = getppid();
    memory.origin = std::numeric_limits<std::int64_t>::max();
    cs::blockStopSignals();
    SimplexTree tree{types()};
    tree.add<Counter>("/robot/counter", "Counter", memory.executed);
    tree.relateRemote(tree.add<Watcher>("/robot/watcher", "Watcher", memory), "button",
                      "/hand/button");
    cs::ClusterCS cluster{"robot"};
    start(cluster, tree, network(peer, security));
    // The watcher does not start before it has a button.
    for (bool started = false; !cs::waitForInterrupt(0.0005) && getppid() == parent;) {
        started = started || startUp(cluster, "robot").outcome == Outcome::Done;
        const Image image = cluster.image();
        const bool good = image.quality("/hand/button") == Quality::Good;
        memory.newest = good ? image.get<std::int64_t>("/hand/button", "written") : 0;
    }
}

RobotProcess::RobotProcess(const std::string& peer, const std::string& security)
    : file_{memfd_create("robot", 0)} {
    if (ftruncate(file_, sizeof(Memory)) != 0) throw std::runtime_error("no shared memory");
    memory_ = shared(file_);
    std::string program = "/proc/self/exe", role = "robot", file = std::to_string(file_);
    std::string copy = peer, folder = security;
    char* words[] = {program.data(), role.data(), file.data(), copy.data(), folder.data(), nullptr};
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ > 0) return;
    execv(program.c_str(), words);
    _exit(127);
}

RobotProcess::~RobotProcess() {
    end();
    munmap(memory_, sizeof(Memory));
    close(file_);
}

void RobotProcess::end() {
    if (process_ == 0) return;
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    process_ = 0;
}

std::int64_t RobotProcess::newest() const { return memory_->newest; }
int RobotProcess::presses() const { return memory_->presses; }
std::vector<Seen> RobotProcess::seen() const { return memory_->seen.taken(); }
Clock::time_point RobotProcess::timeOf(std::int64_t wakeUp) const {
    return Clock::time_point{Clock::duration{memory_->origin + wakeUp}};
}
std::vector<Executed> RobotProcess::executed() const { return memory_->executed.taken(); }

Station::Station(const comms::NetworkOptions& network) : mirror_{"station", network} {
    mirror_.view({"/"}, 100);
    mirror_.onEvent([this](const comms::AgentEvent& event) {
        const std::lock_guard lock{mutex_};
        if (event.severity == Severity::Warning) warnings_.push_back(event.text);
    });
    thread_ = std::thread{[this] {
        for (auto next = Clock::now(); !stop_; next = std::max(next + 20ms, Clock::now())) {
            if (sends_) send();
            poll();
            std::this_thread::sleep_until(next);
        }
    }};
}

Station::~Station() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
}

std::int64_t Station::cycleOfRobot() {
    for (const comms::AgentStatus& each : mirror_.agents()) {
        if (each.name == "robot") return each.cycle;
    }
    return 0;
}

void Station::send() {
    if (mirror_.structure("robot") == nullptr) return;
    const auto number = static_cast<std::int64_t>(sent_.size()) + 1;
    pending_[mirror_.send("/robot/counter", "increment", {{"number", Value{std::vector{number}}}},
                          budget)] = number;
    sent_[number].latest = cycleOfRobot() + budget / 1ms;
}

void Station::poll() {
    std::erase_if(pending_, [this](const auto& each) {
        comms::CommandAnswer answer;
        if (!mirror_.poll(each.first, answer)) return false;
        sent_[each.second].outcome = answer.outcome;
        if (answer.done()) ++done_;
        return true;
    });
}

bool Station::sees(std::int64_t newerThan) {
    for (const comms::AgentStatus& each : mirror_.agents()) {
        const bool runs = each.state == "running" || each.state == "overloaded";
        if (each.name != "robot" || !runs) continue;
        const comms::AgentImage image = mirror_.image("robot");
        if (!image || image->cycle() <= newerThan) return false;
        const auto& simplexes = image->structure().simplexes;
        return std::ranges::all_of(simplexes, [&](const SimplexInfo& info) {
            return info.remote || image->quality(info.path) == Quality::Good;
        });
    }
    return false;
}

std::map<std::int64_t, Station::Sent> Station::end() {
    stop_ = true;
    thread_.join();
    for (const auto end = Clock::now() + 20s; !pending_.empty() && Clock::now() < end;) {
        poll();
        std::this_thread::sleep_for(1ms);
    }
    return sent_;
}

std::vector<std::string> Station::warnings() const {
    const std::lock_guard lock{mutex_};
    return warnings_;
}

std::int64_t Station::count() {
    const comms::AgentImage image = mirror_.image("robot");
    return image ? image->get<std::int64_t>("/robot/counter", "count") : -1;
}

}  // namespace cortex::test
