// SPDX-License-Identifier: Apache-2.0
#include "toolkit/fieldbus_rig.hpp"

#include "cortex/core/agent.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace cortex::toolkit::test {
namespace {

using namespace std::chrono_literals;
using cortex::test::patience;

bool isReadable(int descriptor, std::chrono::milliseconds time) {
    pollfd wanted{descriptor, POLLIN, 0};
    return poll(&wanted, 1, static_cast<int>(time.count())) > 0;
}

void expect(bool isRight, const char* what) {
    if (!isRight) throw std::runtime_error(std::string{"the boiler's server: "} + what);
}

// "127.0.0.1:40000"
sockaddr_in socketAddress(const std::string& address) {
    const std::size_t colon = address.find(':');
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(std::atoi(address.c_str() + colon + 1)));
    inet_pton(AF_INET, address.substr(0, colon).c_str(), &place.sin_addr);
    return place;
}

}  // namespace

BoilerServer::BoilerServer() : listener_{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
    sockaddr_in place = socketAddress("127.0.0.1:0");
    socklen_t size = sizeof place;
    auto* general = reinterpret_cast<sockaddr*>(&place);
    expect(bind(listener_, general, size) == 0, "bind");
    expect(getsockname(listener_, general, &size) == 0, "getsockname");
    address_ = "127.0.0.1:" + std::to_string(ntohs(place.sin_port));
}

BoilerServer::~BoilerServer() { end(); }

void BoilerServer::end() {
    hangUp();
    if (listener_ >= 0) ::close(std::exchange(listener_, -1));
}

void BoilerServer::listen() const { expect(::listen(listener_, 4) == 0, "listen"); }

void BoilerServer::accept(std::chrono::seconds time) {
    hangUp();
    expect(isReadable(listener_, time), "nobody connects");
    line_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    expect(line_ >= 0, "accept");
}

void BoilerServer::say(double number) const {
    expect(::send(line_, &number, sizeof number, MSG_NOSIGNAL) == sizeof number, "send");
}

double BoilerServer::hear() const {
    double number = 0;
    expect(isReadable(line_, patience), "the device asks nothing");
    expect(::recv(line_, &number, sizeof number, MSG_WAITALL) == sizeof number, "the device left");
    return number;
}

bool BoilerServer::isLeft() const {
    double number = 0;
    expect(isReadable(line_, patience), "the device stays");
    return ::recv(line_, &number, sizeof number, MSG_WAITALL) <= 0;
}

void BoilerServer::hangUp() {
    if (line_ >= 0) ::close(std::exchange(line_, -1));
}

void Boiler::populate() {
    power_ = input("heater").data<double>("power", "W");
    temperature_ = output("water").data<double>("temperature", "Cel");
    populateLink();
    asked = atDevice([this] { work(); });
}

void Boiler::connect() {
    const std::string& address = settings().address;
    const sockaddr_in place = socketAddress(address);
    line_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::connect(line_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
        throw LinkError(address + ": " + std::strerror(errno) + "; is the boiler on?");
    if (read() != BoilerServer::identity)
        throw LinkRefused(address + ": it is another device; is the address right?");
}

double Boiler::read() const {
    const auto time =
        std::chrono::duration_cast<std::chrono::milliseconds>(settings().responseTimeout);
    double number = 0;
    if (!isReadable(line_, time)) throw LinkError(settings().address + ": no answer");
    if (::recv(line_, &number, sizeof number, MSG_WAITALL) != sizeof number)
        throw LinkError(settings().address + ": it hung up");
    return number;
}

void Boiler::exchange(const Request& request, Answer& answer) {
    if (isWrong.exchange(false)) throw std::logic_error("it cannot count");
    ::send(line_, &request.power, sizeof request.power, MSG_NOSIGNAL);
    answer.temperature = read();
    if (std::isnan(answer.temperature))
        throw LinkError(settings().address + ": its answer is no temperature");
}

void Boiler::close() noexcept {
    if (line_ >= 0) ::close(std::exchange(line_, -1));
}

void Boiler::stateStandby(const Tick&) {
    if (std::exchange(asks, false)) wasBegun = asked.begin();
    if (std::exchange(faults, false)) fault(1, "as the test wants");
}

BoilerPlant::BoilerPlant(const std::string& address, const Pairs& settings)
    : TestPlant{{CORTEX_SOURCE_DIR "/tests/data/fieldbus-rules.xml"}, 1s} {
    classes().add<Boiler>("Boiler");
    add("/power", "BoilerPower");
    add("/water", "BoilerTemperature");
    Pairs all{{"address", address},
              {"exchangePeriod", "0.001"},
              {"responseTimeout", "10"},
              {"lossTime", "40"},
              {"reconnectTime", "0.01"}};
    for (const auto& [item, value] : settings) {
        std::erase_if(all, [&](const auto& each) { return each.first == item; });
        all.emplace_back(item, value);
    }
    add("/boiler", "Boiler", {{"heater", "/power"}, {"water", "/water"}}, all);
}

void BoilerPlant::start() {
    cluster().addEventSink([events = events_](const Event& event, const Structure&) {
        const std::lock_guard lock{events->mutex};
        events->text += std::string{event.text.view()} + "\n";
    });
    TestPlant::start();
}

Quality BoilerPlant::quality() {
    const Image image = cluster().image();
    return image.state(image.structure().find("/water")).quality;
}

std::string BoilerPlant::events() {
    cluster().agent().events().flush();
    const std::lock_guard lock{events_->mutex};
    return events_->text;
}

void BoilerPlant::stepUntil(const std::string& what, const std::function<bool()>& condition) {
    cortex::test::waitUntil(
        what,
        [&] {
            if (condition()) return true;
            step();
            return false;
        },
        [this] { return events(); });
}

Boiler& BoilerPlant::boiler() { return static_cast<Boiler&>(tree().at("/boiler")); }

}  // namespace cortex::toolkit::test
