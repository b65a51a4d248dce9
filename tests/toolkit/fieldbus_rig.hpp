// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/testing.hpp"
#include "cortex/toolkit/fieldbus_device.hpp"

#include "support/waiting.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace cortex::toolkit::test {

// The boiler itself: a TCP server that does what the test says, and nothing by itself. After the
// connection it says who it is (one double), then it answers each double by another one.
class BoilerServer {
public:
    static constexpr double identity = 7;

    BoilerServer();  // has an address, at which nobody listens yet
    ~BoilerServer();
    BoilerServer(const BoilerServer&) = delete;
    BoilerServer& operator=(const BoilerServer&) = delete;

    const std::string& address() const { return address_; }
    void listen() const;
    // All wait, and throw where the device does not do its part in time.
    void accept(std::chrono::seconds time = cortex::test::patience);  // and says nothing yet
    void say(double number) const;
    double hear() const;  // the next request
    bool isLeft() const;  // the device has closed it
    void hangUp();
    void end();  // before the plant ends, whose device would wait for it
    void welcome() {
        accept();
        say(identity);
    }

private:
    std::string address_;
    int listener_ = -1, line_ = -1;
};

struct Answer {
    double temperature = 0;
};
struct Request {
    double power = 0;
};

class Boiler final : public FieldbusDevice<Answer, Request> {
public:
    using FieldbusDevice::FieldbusDevice;
    ~Boiler() override { close(); }

    static constexpr double quietPower = -1;
    // What its next hook does, and what `work` asks the thread for.
    bool faults = false, asks = false, wasBegun = false;
    std::function<void()> work;
    cs::SlowWork asked;
    std::atomic<bool> isWrong{false};  // its next exchange throws what is no LinkError
    using FieldbusDevice::isLost;
    using FieldbusDevice::link;

private:
    void populate() override;
    void connect() override;
    void exchange(const Request& request, Answer& answer) override;
    void close() noexcept override;
    void pack(Request& request) override { request.power = power_; }
    void quiet(Request& request) override { request.power = quietPower; }
    void unpack(const Answer& answer) override { temperature_ = answer.temperature; }
    void stateStandby(const Tick& tick) override;

    double read() const;
    Data<const double> power_;
    Data<double> temperature_;
    int line_ = -1;
};

// One boiler, and a loop that is stepped: a cycle is a second. No time of the machine decides
// anything, as an answer may take 10 s of it.
class BoilerPlant : public cs::TestPlant {
public:
    explicit BoilerPlant(const std::string& address, const Pairs& settings = {});

    void start();
    double temperature() { return get<double>("/water", "temperature"); }
    Quality quality();
    Link link() { return static_cast<Link>(count("link")); }
    std::int64_t count(const std::string& item) { return get<std::int64_t>("/boiler", item); }
    double age() { return get<double>("/boiler", "age") * 1e-3; }  // s
    std::string events();
    bool hasEvent(const std::string& text) { return events().find(text) != std::string::npos; }
    void stepUntil(const std::string& what, const std::function<bool()>& condition);
    Boiler& boiler();

private:
    struct Events {
        std::mutex mutex;
        std::string text;
    };
    std::shared_ptr<Events> events_ = std::make_shared<Events>();  // outlives the plant's end
};

}  // namespace cortex::toolkit::test
