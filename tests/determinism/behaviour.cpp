// SPDX-License-Identifier: Apache-2.0
#include "determinism/behaviour.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace cortex::determinism {

namespace {

std::uint64_t bits(double number) { return std::bit_cast<std::uint64_t>(number); }
std::uint64_t bits(std::int64_t number) { return static_cast<std::uint64_t>(number); }

std::uint64_t bits(std::string_view text) {
    std::uint64_t sum = text.size();
    for (const char each : text) sum = sum * 131 + static_cast<unsigned char>(each);
    return sum;
}

}  // namespace

void Behaviour::sense(World& world) {
    for (const InputPort& input : world.inputs) {
        for (const double* number : input.numbers) chance_.mix(bits(*number));
        for (const std::int64_t* integer : input.integers) chance_.mix(bits(*integer));
        for (const bool* flag : input.flags) chance_.mix(*flag ? 1 : 2);
        for (const auto& text : input.texts) chance_.mix(bits(text()));
        chance_.mix(static_cast<std::uint64_t>(input.quality()));
        chance_.mix(bits(input.stamp()));
    }
    for (const OutputPort& output : world.outputs) {
        for (const auto& number : output.accepted) chance_.mix(bits(number()));
    }
    for (const SenderPort& sender : world.senders) {
        const SeenAnswer answer = sender.answer();
        chance_.mix(static_cast<std::uint64_t>(answer.outcome) * 16 +
                    static_cast<std::uint64_t>(answer.reason));
        chance_.mix(answer.number * 65536 + answer.sent * 256 + answer.answered);
        chance_.mix(bits(answer.latencyCycles));
        chance_.mix(bits(answer.why));
        chance_.mix(bits(answer.sum));
        *world.result += answer.sum / 16;
    }
    for (const LifePort& life : world.lives) chance_.mix(static_cast<std::uint64_t>(life.state()));
    chance_.mix(bits(*world.gain));
    chance_.mix(bits(*world.choice));
}

void Behaviour::mayFail(World& world, std::uint64_t oneIn) {
    if (!wild_ || !chance_.oneIn(oneIn)) return;
    switch (chance_.below(4)) {
        case 0:
            throw std::runtime_error{"thrown by chance, with many more words than fit the item"};
        case 1:
            throw 42;
        default:
            world.fault(static_cast<std::int64_t>(chance_.below(9)) + 1, "faulted by chance");
    }
}

void Behaviour::writeNumber(double& number, double scale) {
    if (wild_ && chance_.oneIn(1500)) {
        number = chance_.oneIn(2) ? std::numeric_limits<double>::quiet_NaN()
                                  : -std::numeric_limits<double>::infinity();
    } else {
        number = chance_.between(-scale, scale) * (wild_ && chance_.oneIn(150) ? 2 : 0.9);
    }
}

void Behaviour::write(World& world) {
    for (OutputPort& output : world.outputs) {
        for (std::size_t i = 0; i < output.numbers.size(); ++i) {
            writeNumber(*output.numbers[i], output.scales[i]);
        }
        for (std::int64_t* integer : output.integers) {
            *integer = static_cast<std::int64_t>(chance_.below(1000));
            if (wild_ && chance_.oneIn(100)) *integer += 700;
        }
        for (bool* flag : output.flags) *flag = chance_.oneIn(2);
        for (const auto& text : output.texts) {
            text(std::string{"text "} + std::to_string(chance_.below(100'000'000'000)));
        }
    }
}

void Behaviour::talk(World& world) {
    for (SenderPort& sender : world.senders) {
        if (!chance_.oneIn(3)) continue;
        for (std::uint64_t n = 1 + chance_.below(3); n > 0; --n) {
            const double amount = chance_.between(-8, 8) * (chance_.oneIn(12) ? 1.8 : 1);
            const auto number =
                static_cast<std::int64_t>(chance_.below(6) * mostSimplexes + world.index);
            chance_.mix(static_cast<std::uint64_t>(sender.send(amount, number)));
        }
    }
    for (LifePort& life : world.lives) {
        const State state = life.state();
        if (state == State::Standby && chance_.oneIn(4)) life.post(LifeCycle::Startup);
        if (state == State::Fault && chance_.oneIn(3)) life.post(LifeCycle::ClearFaults);
        if (state == State::Active && chance_.oneIn(50)) life.post(LifeCycle::Shutdown);
        if (chance_.oneIn(80)) life.post(LifeCycle::Startup);
    }
}

void Behaviour::loopStart(World& world, const Tick& tick) {
    chance_.mix(bits(tick.cycle));
    chance_.mix(bits(tick.nominalTime));
    chance_.mix(bits(tick.passed));
    chance_.mix(bits(tick.elapsed));
    if (chance_.oneIn(25)) {
        world.event(Severity::Info, std::string{"number "} + std::to_string(chance_.below(1000)));
    }
    if (chance_.oneIn(60)) write(world);
    mayFail(world, 700);
}

void Behaviour::standby(World& world) {
    sense(world);
    if (chance_.oneIn(12)) talk(world);
    if (chance_.oneIn(15)) write(world);
}

bool Behaviour::startingUp(World& world) {
    if (chance_.oneIn(5)) write(world);
    mayFail(world, 100);
    return chance_.oneIn(2);
}

void Behaviour::active(World& world, const Tick& tick) {
    sense(world);
    write(world);
    talk(world);
    if (world.exchange.choices > 0) {
        if (chance_.oneIn(7)) {
            // Mostly one of them; now and then several together, or none.
            wanted_ = std::uint64_t{1} << chance_.below(world.exchange.choices);
            if (chance_.oneIn(6))
                wanted_ = chance_.below(std::uint64_t{1} << world.exchange.choices);
        }
        chance_.mix(static_cast<std::uint64_t>(world.exchange.handOver(wanted_, tick)));
    }
    if (chance_.oneIn(25)) {
        const auto age = static_cast<std::int64_t>(chance_.below(12)) * period;
        const bool old = chance_.oneIn(2);  // perhaps from before the start
        world.setQuality(static_cast<Quality>(chance_.below(wild_ ? 4 : 2)),
                         old ? tick.nominalTime - age : std::numeric_limits<std::int64_t>::min());
    }
    mayFail(world, 250);
    *world.total += static_cast<std::int64_t>(chance_.below(1'000'000));
    *world.result = std::fmod(*world.result + chance_.between(-1, 1) * *world.gain, 1000);
    world.words(std::string{"now "} + std::to_string(chance_.next()));
}

bool Behaviour::shuttingDown(World& world) {
    if (chance_.oneIn(5)) write(world);
    mayFail(world, 150);
    return chance_.oneIn(2);
}

bool Behaviour::inFault(World& world) {
    sense(world);
    if (chance_.oneIn(6)) write(world);
    mayFail(world, 300);
    return !chance_.oneIn(3);
}

void Behaviour::loopEnd(World& world, const Tick&) {
    if (chance_.oneIn(60)) write(world);
    mayFail(world, 900);
    if (chance_.oneIn(40)) world.event(Severity::Warning, "at the end");
}

Reply Behaviour::command(World& world, const Request& request) {
    chance_.mix(bits(request.command));
    chance_.mix(bits(request.amount));
    chance_.mix(bits(request.number));
    chance_.mix(request.first ? 3 : request.cancelling ? 4 : 5);
    ++*world.heard;
    *world.total += request.number;
    if (chance_.oneIn(8)) write(world);
    if (request.command == "zap") return zap(world);
    if (request.command == "work" || request.command == "renew") return work(world, request);
    *world.result = std::fmod(*world.result + request.amount, 1000);
    return {.sum = *world.result};
}

Reply Behaviour::zap(World& world) {
    switch (chance_.below(24)) {
        case 0:
            throw std::runtime_error{"zapped"};
        case 1:
            world.fault(77, "zapped");
            return {};
        case 2:
            return {Outcome::Running};
        case 3:
            return {Outcome::Unknown};
        case 4:
        case 5:
            return {Outcome::Failed, Reason::None, "no luck"};
        case 6:
        case 7:
            return {Outcome::Rejected, Reason::State, "not today"};
        default:
            return {.sum = chance_.between(0, 10)};
    }
}

Reply Behaviour::work(World& world, const Request& request) {
    if (request.first) left_ = static_cast<int>(chance_.below(14));
    *world.progress = 1 / (1.0 + left_);
    if (request.cancelling) {
        if (wild_ && chance_.oneIn(8)) throw std::runtime_error{"does not stop"};
        return {Outcome::Cancelled};
    }
    if (wild_ && chance_.oneIn(60)) throw std::runtime_error{"work is dangerous"};
    if (left_-- > 0) return {Outcome::Running, Reason::None, {}, 0.25};
    if (chance_.oneIn(4)) return {Outcome::Failed, Reason::None, "it did not work"};
    return {.sum = *world.result};
}

}  // namespace cortex::determinism
