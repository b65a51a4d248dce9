// SPDX-License-Identifier: Apache-2.0
#include "comms/order_simulation.hpp"

#include "cortex/core/agent.hpp"

#include "agent/agent_commands.hpp"
#include "core/model_folder.hpp"
#include "support/agent_rig.hpp"
#include "wire/ids.hpp"

#include <algorithm>
#include <functional>

namespace cortex::comms {
namespace {

constexpr std::int64_t longestWait = 450, slow = 10;         // cycles
constexpr std::array paths{"/rig", "/a", "/b", "/c", "/d"};  // the first concerns all
constexpr std::size_t slowOne = 2;
constexpr const char* lostAgent = "it is lost";

const TypeModel& types() {
    static const TypeModel model = [] {
        const test::ModelFolder folder;
        folder.write("m.xml",
                     "<morphology name='m'><include file='base-morphology.xml'/>"
                     "<include file='t.xml'/></morphology>");
        folder.write("t.xml",
                     "<ontology name='t'><include file='base.xml'/>"
                     "<type name='Station' extends='Agent'><command name='act' available='always'>"
                     "<request name='number' kind='int'/></command></type>"
                     "<type name='Machine' extends='Active Activity'>"
                     "<command name='act' available='always'>"
                     "<request name='number' kind='int'/></command>"
                     "<command name='work' available='always' long='true' onBusy='replace'>"
                     "<request name='number' kind='int'/></command></type></ontology>");
        return TypeModel::load(folder.path() / "m.xml");
    }();
    return model;
}

}  // namespace

class PlantInterface final : public CommunicationInterface {
public:
    explicit PlantInterface(std::function<void(const Answer&)> send) : send_{std::move(send)} {}
    void announce(const AgentAccess& agent) override {
        self = std::make_unique<AgentSelf>(agent);
        commands = std::make_unique<AgentCommands>(*self, send_);
    }
    void read(Inbox& inbox) override { commands->read(inbox); }
    void write(std::int64_t, Outbox& outbox) override { commands->write(outbox); }
    void close() override {}

    std::unique_ptr<AgentSelf> self;
    std::unique_ptr<AgentCommands> commands;

private:
    std::function<void(const Answer&)> send_;
};

// What the agent tells of each command that it executes: its number, and how a long one ended.
struct Executed {
    std::function<void(std::size_t)> begins;
    std::function<void(std::size_t, Outcome)> ends;
};

// One start of the agent.
struct Plant {
    Plant(std::int64_t epoch, std::uint32_t room, std::function<void(const Answer&)> send,
          const Executed& tell)
        : network{std::move(send)},
          rig{types(), "rig", {.outsideCommands = room, .epoch = epoch}},
          tables{(addHands(tell), network.self->access.structure)},
          model{"rig", epoch} {
        Presence presence;
        presence.agent = agentId("rig");
        presence.name = "rig";
        presence.epoch = epoch;
        presence.period = 1'000'000;
        presence.interval = shortestInterval;
        model.add(presence);
    }
    void addHands(const Executed& tell) {
        rig.add(network);
        for (const char* path : paths) {
            hands.push_back(&rig.hand(path, hands.empty() ? "Station" : "Machine"));
        }
        rig.make();
        for (test::Hand* hand : hands) {
            const auto number = hand->argument<std::int64_t>("act", "number");
            hand->on("act", [tell, number](Call& call) {
                tell.begins(static_cast<std::size_t>(call[number]));
                return Outcome::Done;
            });
            if (hand == hands.front()) continue;
            hand->run = [this, hand] { changeState(*hand); };
            addWork(*hand, tell);
        }
        rig.start();
        for (std::size_t i = 1; i < hands.size(); ++i) rig.setState(*hands[i], State::Active);
    }
    // Takes up to 300 cycles; one of two fails, and a later one takes its place.
    static void addWork(test::Hand& hand, const Executed& tell) {
        const auto number = hand.argument<std::int64_t>("work", "number");
        hand.on("work", [tell, number, left = 0](Call& call) mutable {
            const auto id = static_cast<std::size_t>(call[number]);
            if (call.first()) {
                left = static_cast<int>(id * 7919 % 300);
                tell.begins(id);
            }
            if (call.cancelling()) return tell.ends(id, Outcome::Cancelled), Outcome::Cancelled;
            if (left-- > 0) return Outcome::Running;
            const bool fails = id % 2 == 1;
            tell.ends(id, fails ? Outcome::Failed : Outcome::Done);
            return fails ? call.fail("its number is odd") : Outcome::Done;
        });
    }
    void changeState(test::Hand& hand) {
        const LifeCycle command = rig.agent->takeLifeCycle(hand.index(), rig.agent->thread(0));
        if (command == LifeCycle::Startup) rig.setState(hand, State::Active);
        if (command == LifeCycle::Shutdown) rig.setState(hand, State::Standby);
    }
    void cycle() {
        rig.order.assign(paths.begin() + 1, paths.end());
        if (rig.tick.cycle % slow != 0) rig.order.erase(rig.order.begin() + slowOne - 1);
        rig.step();
    }

    PlantInterface network;
    test::AgentRig rig;
    std::vector<test::Hand*> hands;
    CommandTables tables;
    PeerModel model;
};

Faults chaos(std::uint64_t seed) {
    std::mt19937_64 random{seed};
    Faults faults;
    faults.loss = std::array{0.0, 0.01, 0.05, 0.2, 0.4}[random() % 5];
    faults.rate = std::array{0.03, 0.2, 1.0}[random() % 3];
    faults.late = std::array{0.0, 0.1, 0.5}[random() % 3];
    faults.latest = std::array{5, 30, 300}[random() % 3];
    faults.copies = 0.05;
    faults.killed = 0.0002;
    faults.cut = 0.00005;
    faults.agentKilled = 0.00003;
    faults.stands = 0.0002;
    faults.stops = 0.02;
    faults.takesLong = 0.05;
    faults.wide = 0.03;
    faults.refused = 0.02;
    faults.notHeard = 0.01;
    faults.shortBudgets = faults.wrongClocks = true;
    return faults;
}

Simulation::Simulation(std::uint64_t seed, const Faults& faults) : random_{seed}, faults_{faults} {
    for (std::size_t i = 0; i < senders_.size(); ++i) startSender(i);
}

Counts Simulation::run(std::int64_t steps) {
    startAgent();
    while (now_ < steps) step(true);
    while (now_ < steps + 8'000 && unanswered() > 0) step(false);
    counts_.unanswered = unanswered();
    return counts_;
}

int Simulation::unanswered() const {
    std::size_t count = 0;
    for (const Station& each : senders_) count += each.open.size();
    return static_cast<int>(count);
}

bool Simulation::happens(double share) {
    return static_cast<double>(random_() >> 11U) * 0x1p-53 < share;
}
std::int64_t Simulation::between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low));
}

void Simulation::startSender(std::size_t index) {
    Station& self = senders_[index];
    ++self.start;
    self.epoch +=
        happens(faults_.wrongClocks ? 0.1 : 0) ? -between(1, 5'000) : between(10'000, 20'000);
    while (self.epoch <= 0 || !epochs_.insert({index, self.epoch}).second) ++self.epoch;
    Sender sender;
    const std::string name = "tool" + std::to_string(index);
    std::ranges::copy(name, sender.name.begin());
    sender.epoch = self.epoch;
    self.commands = std::make_unique<SentCommands>(sender);
    self.target = plant_;
}

void Simulation::startAgent() {
    plant_ = std::make_shared<Plant>(
        ++agentEpoch_, faults_.room, [this](const Answer& answer) { takeAnswer(answer); },
        Executed{[this](std::size_t id) { executed_.push_back(id); },
                 [this](std::size_t id, Outcome how) { truths_[id].end = how; }});
}

void Simulation::step(bool faulty) {
    ++now_;
    faulty_ = faulty;
    for (std::size_t i = 0; i < senders_.size(); ++i) stepSender(i, faulty);
    while (!network_.empty() && network_.top().at <= now_) {
        const Packet packet = network_.top();
        network_.pop();
        deliver(packet);
    }
    stepAgent(faulty);
}

void Simulation::stepSender(std::size_t index, bool faulty) {
    Station& self = senders_[index];
    if (now_ < self.asleepUntil) return;
    if (!self.commands) startSender(index);
    if (self.target == nullptr) self.target = plant_;
    if (faulty && happens(faults_.killed)) {
        self.commands.reset();
        self.open.clear();
        self.asleepUntil = now_ + between(20, 600);
        return;
    }
    if (faulty && happens(faults_.cut)) self.cutUntil = now_ + between(100, 3'000);
    if (plant_ != nullptr && self.target != plant_ && happens(0.02)) {
        self.target = plant_;
        self.commands->lose("rig", lostAgent);
    }
    if (plant_ != nullptr && now_ % 100 == 0 && now_ >= self.cutUntil) {
        Presence presence;
        presence.name = "tool" + std::to_string(index);
        presence.epoch = self.epoch;
        presence.interval = shortestInterval;
        plant_->network.commands->heard(presence, clock());
    }
    if (faulty && self.target != nullptr && happens(faults_.rate)) send(index);
    self.commands->tick(moment(), [&](const Command& message) {
        write(index, message);
        return true;
    });
    poll(index);
}

void Simulation::send(std::size_t index) {
    Station& self = senders_[index];
    const std::size_t id = truths_.size();
    Truth& truth = truths_.emplace_back();
    truth.sender = index;
    truth.start = self.start;
    truth.refused = happens(faults_.refused);
    const bool wide = happens(faults_.wide), stop = !wide && happens(faults_.stops);
    truth.simplex = wide ? 0 : static_cast<std::size_t>(between(1, paths.size()));
    truth.lifeCycle = stop;
    truth.isLong = !wide && !stop && happens(faults_.takesLong);
    CommandClient::Arguments arguments;
    if (!stop) arguments["number"] = Value{std::vector{static_cast<std::int64_t>(id)}};
    const char* name = truth.isLong ? "work" : "act";
    if (stop) name = happens(0.5) ? "shutdown" : "startup";
    std::int64_t budget = 1'000;
    if (faults_.shortBudgets && happens(0.2)) {
        budget = happens(0.5) ? between(5, 100) : between(1'000, 5'000);
    }
    const Plant& target = *self.target;
    const std::uint64_t number = self.commands->send(
        {target.model, target.tables, target.rig.tick.cycle, moment(), 0, moment(),
         happens(faults_.notHeard)},
        paths[truth.simplex], name, arguments, std::chrono::milliseconds{budget}, moment());
    CallResult result;
    if (self.commands->poll(number, result)) return;  // it was not sent
    auto& sequences = sequences_[{index, self.epoch}];
    sequences.push_back(id);
    truth.sequence = sequences.size();
    self.open.emplace_back(number, id);
    ++counts_.sent;
}

// Whether this start's clock lies behind that of an earlier start of the same sender.
bool Simulation::clockWentBack(std::size_t index) const {
    const auto later = epochs_.upper_bound({index, senders_[index].epoch});
    return later != epochs_.end() && later->first == index;
}

void Simulation::poll(std::size_t index) {
    Station& self = senders_[index];
    std::erase_if(self.open, [&](const auto& each) {
        CallResult result;
        Truth& truth = truths_[each.second];
        truth.ran = truth.ran || self.commands->running(each.first);
        if (!self.commands->poll(each.first, result)) return false;
        judgeEnd(truth, result);
        truth.outcome = result.outcome;
        const bool ran = result.outcome == Outcome::Done && !truth.lifeCycle;
        // Where a clock went back, a copy of the earlier start can refuse a repeat of what has run.
        const bool excused = result.reason == Reason::Restarted && clockWentBack(index);
        const bool refused = result.outcome == Outcome::Rejected && !truth.lifeCycle && !excused;
        const bool surelyNot =
            result.outcome == Outcome::Expired || result.outcome == Outcome::MailboxFull || refused;
        if ((ran && !truth.begun) || (surelyNot && truth.begun)) {
            lie(truth, std::string{"answered "} + result.text());
        }
        if (result.outcome == Outcome::Expired) ++counts_.expired;
        return true;
    });
}

// What its sender knew to run has its true end, whatever was lost.
void Simulation::judgeEnd(const Truth& truth, const CallResult& result) {
    const bool mayBeUnknown = result.why == lostAgent;
    if (truth.ran && !mayBeUnknown) {
        if (result.outcome == Outcome::Unknown) ++counts_.forgotten;
        ++counts_.ended;
    }
    if (truth.isLong && truth.begun && result.outcome != truth.end &&
        result.outcome != Outcome::Unknown) {
        lie(truth, std::string{"ended "} + name(truth.end) + ", answered " + result.text());
    }
}

void Simulation::write(std::size_t index, const Command& message) {
    const auto& sequences = sequences_[{index, message.senderEpoch}];
    if (message.sequenceNumber > sequences.size()) {
        ++counts_.gaps;  // a number was used for what was not sent
        return;
    }
    Truth& truth = truths_[sequences[message.sequenceNumber - 1]];
    truth.notAfter = message.notAfter;
    Packet packet;
    packet.sender = index;
    packet.command = message;
    if (truth.refused) packet.command->command = "nothing";  // of another version of the types
    put(std::move(packet));
}

void Simulation::put(Packet packet) {
    const bool cut = now_ < senders_[packet.sender].cutUntil;
    if (cut || (faulty_ && happens(faults_.loss))) return;
    for (int copies = happens(faults_.copies) ? 2 : 1; copies > 0; --copies) {
        packet.at = now_ + 1 + (happens(faults_.late) ? between(1, faults_.latest) : 0);
        packet.tie = ++tie_;
        network_.push(packet);
    }
}

void Simulation::deliver(const Packet& packet) {
    Station& self = senders_[packet.sender];
    if (packet.answer) {
        if (self.commands) self.commands->take(*packet.answer);
        return;
    }
    if (plant_ == nullptr) return;
    const Command& message = *packet.command;
    Truth& truth =
        truths_[sequences_[{packet.sender, message.senderEpoch}][message.sequenceNumber - 1]];
    const bool here = message.targetEpoch == agentEpoch_;
    if (here && truth.came < 0) truth.came = plant_->rig.tick.cycle + 1;
    plant_->network.commands->take(message, clock());
}

void Simulation::stepAgent(bool faulty) {
    if (plant_ == nullptr) {
        if (now_ >= downUntil_) startAgent();
        return;
    }
    if (faulty && happens(faults_.agentKilled)) {
        plant_->rig.agent.reset();  // nobody hears what it answers at its end
        plant_.reset();
        downUntil_ = now_ + between(50, 800);
        return;
    }
    if (faulty && now_ >= standsUntil_ && happens(faults_.stands)) {
        standsUntil_ = now_ + between(5, 2'000);
    }
    executed_.clear();
    if (now_ >= standsUntil_) plant_->cycle();
    plant_->network.commands->step(clock());  // life-cycle commands begin before the tasks
    for (const std::size_t id : executed_) begin(id);
}

void Simulation::takeAnswer(const Answer& answer) {
    const std::size_t index = static_cast<std::size_t>(answer.sender.back() - '0');
    const auto& sequences = sequences_[{index, answer.senderEpoch}];
    const std::size_t id = sequences[answer.sequenceNumber - 1];
    Truth& truth = truths_[id];
    if (answer.outcome == "Running" && truth.lifeCycle && !truth.begun) begin(id);
    Packet packet;
    packet.sender = index;
    packet.answer = answer;
    put(std::move(packet));
}

void Simulation::lie(const Truth& truth, const std::string& how) {
    ++counts_.lies;
    counts_.lie = "command " + std::to_string(truth.sequence) + " of start " +
                  std::to_string(truth.start) + " of sender " + std::to_string(truth.sender) +
                  " at " + std::to_string(now_) + " ms, outcome " + name(truth.outcome) + ": " +
                  how;
}

void Simulation::begin(std::size_t id) {
    Truth& truth = truths_[id];
    const std::int64_t cycle = plant_->rig.tick.cycle;
    ++counts_.begun;
    if (std::exchange(truth.begun, true)) ++counts_.twice;
    if (cycle > truth.notAfter) ++counts_.late;
    const bool settled = truth.outcome != Outcome::None && truth.outcome != Outcome::Unknown &&
                         truth.outcome != Outcome::Done;
    if (settled && !truth.lifeCycle) lie(truth, "begins although it was answered");
    const std::int64_t waited = cycle - truth.came - (truth.simplex == slowOne ? slow : 0);
    if (waited > 0) ++counts_.waits;
    if (waited > std::min(longestWait, (truth.notAfter - truth.came) / 2)) ++counts_.longWaits;
    auto& newest = senders_[truth.sender].newest;
    const std::pair mine{truth.start, truth.sequence};
    for (std::size_t i = 0; i < newest.size(); ++i) {
        const bool concerned = i == truth.simplex || i == 0 || truth.simplex == 0;
        if (concerned && newest[i] > mine) {
            ++counts_.disorder;
            break;
        }
    }
    newest[truth.simplex] = std::max(newest[truth.simplex], mine);
}

}  // namespace cortex::comms
