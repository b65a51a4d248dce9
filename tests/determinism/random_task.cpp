// SPDX-License-Identifier: Apache-2.0
#include "determinism/random_task.hpp"

#include "cortex/core/agent.hpp"

#include <algorithm>
#include <map>
#include <thread>

namespace cortex::determinism {

namespace {

int threadNumber() {
    static std::atomic<int> next{1};
    thread_local const int number = next.fetch_add(1);
    return number;
}

}  // namespace

RandomTask::RandomTask(Identity identity, const Plan& plan, std::size_t index,
                       Disturbance& disturbance)
    : SimplexCS{std::move(identity)},
      index_{index},
      self_{plan.simplexes[index]},
      disturbance_{disturbance},
      delays_{disturbance.seed * 1000 + index},
      behaviour_{self_.seed, self_.wild} {}

// Now and then a task takes long, or gives its processor away.
void RandomTask::delay() {
    if (disturbance_.seed == 0 || !delays_.oneIn(8)) return;
    if (delays_.oneIn(8)) return std::this_thread::yield();
    for (volatile std::uint64_t n = delays_.below(4000); n > 0;) n = n - 1;
}

void RandomTask::populate() {
    bindOwn();
    bindRelations();
    bindSenders();
    for (const char* command : {"add", "poke", "zap", "work", "renew"}) {
        if (type().findCommand(command) != nullptr) handleAll(command);
    }
}

void RandomTask::bindOwn() {
    world_.index = index_;
    world_.result = array<double>("result").data();
    world_.gain = array<double>("gain").data();
    world_.total = array<std::int64_t>("total").data();
    world_.heard = array<std::int64_t>("heard").data();
    world_.choice = array<std::int64_t>("choice").data();
    if (type().findData("progress") != nullptr) world_.progress = array<double>("progress").data();
    words_ = data<std::string_view>("words");
    world_.words = [this](std::string_view text) { words_ = text; };
    world_.fault = [this](std::int64_t code, std::string_view text) { fault(code, text); };
    world_.setQuality = [this](Quality quality, std::int64_t at) { setQuality(quality, at); };
    world_.event = [this](Severity severity, std::string_view text) {
        event(severity, EventText{text});
    };
}

void RandomTask::bindRelations() {
    std::map<std::string, std::size_t> places;
    for (const RelationPlan& relation : self_.relations) {
        const std::size_t place = places[relation.rule]++;
        if (type().findRule(relation.rule)->direction == Direction::Input) {
            world_.inputs.push_back(inputPort(inputs(relation.rule)[place]));
        } else if (!outputs(relation.rule)[place].type().active()) {
            world_.outputs.push_back(outputPort(outputs(relation.rule)[place]));
        }
    }
}

void RandomTask::bindSenders() {
    std::vector<std::pair<std::string, std::size_t>> places;
    for (const RelationPlan& relation : self_.relations) {
        const auto before =
            std::ranges::count(places, relation.rule, [](const auto& each) { return each.first; });
        places.emplace_back(relation.rule, static_cast<std::size_t>(before));
    }
    const auto with = [&](std::size_t relation, const auto& use) {
        const auto& [rule, place] = places[relation];
        if (type().findRule(rule)->direction == Direction::Input)
            use(inputs(rule)[place]);
        else
            use(outputs(rule)[place]);
    };
    for (const SenderPlan& sender : self_.senders) {
        with(sender.relation, [&](const auto& related) { addSender(related, sender); });
    }
    for (const std::size_t relation : self_.choices) {
        with(relation, [&](const auto& related) { choices_.push_back(lifeCycle(related, true)); });
    }
    world_.exchange = {choices_.size(), [this](std::uint64_t wanted, const Tick& tick) {
                           return handOver(wanted, tick);
                       }};
    for (const LifePlan& plan : self_.lives) {
        with(plan.relation, [&](const auto& related) {
            LifeCycleSender& sender = lives_.emplace_back(lifeCycle(related, plan.manage));
            world_.lives.push_back({[&sender] { return sender.state(); },
                                    [&sender](LifeCycle command) {
                                        if (command == LifeCycle::Startup) sender.startup();
                                        if (command == LifeCycle::Shutdown) sender.shutdown();
                                        if (command == LifeCycle::ClearFaults) sender.clearFaults();
                                    }});
        });
    }
}

int RandomTask::handOver(std::uint64_t wanted, const Tick& tick) {
    if (choices_.size() == 2 && (wanted == 1 || wanted == 2)) {
        const std::size_t to = wanted - 1;
        return static_cast<int>(choices_[1 - to].handOver(choices_[to], tick));
    }
    const auto isWanted = [wanted](std::size_t place) { return (wanted >> place & 1U) != 0; };
    return static_cast<int>(LifeCycleSender::handOver(choices_, isWanted, tick));
}

InputPort RandomTask::inputPort(const InputSimplex& input) {
    InputPort port;
    for (const DataItem& item : input.type().data) {
        if (item.measured || item.constant) continue;
        const auto append = [](auto& list, auto values) {
            for (const auto& value : values) list.push_back(&value);
        };
        if (item.kind == Kind::Float) append(port.numbers, input.array<double>(item.name));
        if (item.kind == Kind::Int) append(port.integers, input.array<std::int64_t>(item.name));
        if (item.kind == Kind::Bool) append(port.flags, input.array<bool>(item.name));
        if (item.kind == Kind::String && item.length == 1) {
            port.texts.push_back(
                [text = input.data<std::string_view>(item.name)] { return text.get(); });
        }
    }
    const SlotState& state = input.state();
    port.quality = [&state] { return state.quality; };
    port.stamp = [&state] { return state.time; };
    return port;
}

OutputPort RandomTask::outputPort(const OutputSimplex& output) {
    OutputPort port;
    const Structure& structure = runtime().structure();
    const bool demand =
        structure.simplexes[structure.find(output.path())].role == Role::Modification;
    for (const DataItem& item : output.type().data) {
        if (item.measured) {
            loads_.push_back(output.array<std::int64_t>(item.name));
            continue;
        }
        const auto append = [](auto& list, auto values) {
            for (auto& value : values) list.push_back(&value);
        };
        if (demand && item.kind == Kind::Float) {
            for (const double& number : output.acceptedArray<double>(item.name)) {
                port.accepted.emplace_back([&number] { return number; });
            }
        }
        if (item.kind == Kind::Float) {
            append(port.numbers, output.array<double>(item.name));
            port.scales.resize(port.numbers.size(), scaleOf(item));
        }
        if (item.kind == Kind::Int) append(port.integers, output.array<std::int64_t>(item.name));
        if (item.kind == Kind::Bool) append(port.flags, output.array<bool>(item.name));
        if (item.kind == Kind::String) {
            port.texts.push_back([text = output.data<std::string_view>(item.name)](
                                     std::string_view value) mutable { text = value; });
        }
    }
    return port;
}

template <class Related>
void RandomTask::addSender(const Related& related, const SenderPlan& plan) {
    Sender& own = senders_.emplace_back();
    own.isSet = plan.command == "set";
    own.sender = related.command(plan.command, plan.capacity);
    own.amount = own.sender.template argument<double>(own.isSet ? "gain" : "amount");
    own.number = own.sender.template argument<std::int64_t>(own.isSet ? "choice" : "number");
    if (!own.isSet) own.sum = own.sender.template response<double>("sum");
    world_.senders.push_back({[this, &own](double amount, std::int64_t number) {
                                  own.amount = amount;
                                  own.number = own.isSet ? number % 7 : number;
                                  disturbance_.sentOn[index_].store(threadNumber(),
                                                                    std::memory_order_relaxed);
                                  return own.sender.send();
                              },
                              [&own]() -> SeenAnswer {
                                  const AnswerHead& head = own.sender.answer();
                                  return {head.outcome,          head.reason,
                                          head.number,           own.sender.sent(),
                                          own.sender.answered(), head.latencyCycles,
                                          head.why.view(),       own.isSet ? 0 : own.sum.get()};
                              }});
}

void RandomTask::handleAll(std::string_view command) {
    Bound& bound = handlers_.emplace_back(
        Bound{this, std::string{command}, argument<double>(command, "amount"),
              argument<std::int64_t>(command, "number"), result<double>(command, "sum")});
    handle(command, {&bound, [](void* object, Call& call) {
                         const Bound& self = *static_cast<Bound*>(object);
                         const Reply reply = self.task->execute(self, call);
                         call[self.sum] = reply.sum;
                         if (reply.outcome == Outcome::Failed) return call.fail(reply.why);
                         if (reply.outcome == Outcome::Rejected)
                             return call.reject(reply.reason, reply.why);
                         return reply.outcome;
                     }});
}

Reply RandomTask::execute(const Bound& bound, Call& call) {
    delay();
    const std::int64_t number = call[bound.number];
    const auto sender = static_cast<std::size_t>(number) % mostSimplexes;
    if (call.first() && call.sender() == nullptr) {
        const int sentOn = disturbance_.sentOn[sender].load(std::memory_order_relaxed);
        disturbance_.executed.fetch_add(1, std::memory_order_relaxed);
        if (sentOn != threadNumber()) disturbance_.across.fetch_add(1, std::memory_order_relaxed);
    }
    return behaviour_.command(
        world_, {bound.command, call[bound.amount], number, call.first(), call.cancelling()});
}

void RandomTask::loopStart(const Tick& tick) {
    delay();
    for (const auto load : loads_) load.front() = threadNumber();
    behaviour_.loopStart(world_, tick);
}

void RandomTask::stateStandby(const Tick&) {
    delay();
    behaviour_.standby(world_);
}

bool RandomTask::stateStartingUp(const Tick&) {
    delay();
    return behaviour_.startingUp(world_);
}

void RandomTask::stateActive(const Tick& tick) {
    delay();
    behaviour_.active(world_, tick);
    delay();
}

bool RandomTask::stateShuttingDown(const Tick&) {
    delay();
    return behaviour_.shuttingDown(world_);
}

bool RandomTask::stateFault(const Tick&) {
    delay();
    return behaviour_.inFault(world_);
}

void RandomTask::loopEnd(const Tick& tick) { behaviour_.loopEnd(world_, tick); }

}  // namespace cortex::determinism
