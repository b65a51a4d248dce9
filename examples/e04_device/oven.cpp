// SPDX-License-Identifier: Apache-2.0
// An oven behind a serial line, as a plug-in for cortex-agent: the line blocks, the tick does not.
// The program writes "H 350.0", heater at 350 W; the oven answers "T 81.25", 81.25 degrees inside.
#include "cortex/core/registry.hpp"
#include "cortex/cs/io_exchange.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace {

using namespace std::chrono_literals;
using cortex::Data;
using cortex::Tick;

// One connection to the oven; it blocks, and throws when the oven is away or answers nonsense.
class SerialLine {
public:
    explicit SerialLine(const std::string& path)
        : SerialLine{path, open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)} {
        termios raw{};
        if (tcgetattr(file_, &raw) != 0) refuse(std::strerror(errno));
        cfmakeraw(&raw);
        tcsetattr(file_, TCSAFLUSH, &raw);
    }
    ~SerialLine() { close(file_); }
    SerialLine(const SerialLine&) = delete;
    SerialLine& operator=(const SerialLine&) = delete;

    // The temperature, while the heater gives `power` from now on.
    double exchange(double power) const {
        const std::string request = "H " + std::to_string(power) + "\n";
        tcflush(file_, TCIFLUSH);  // a late answer is none to this request
        if (write(file_, request.data(), request.size()) < 0) refuse(std::strerror(errno));
        const std::string answer = readLine();
        const char* const end = answer.data() + answer.size();
        double temperature = 0;
        if (!answer.starts_with("T ") ||
            std::from_chars(answer.data() + 2, end, temperature).ptr != end) {
            refuse("it answered '" + answer + "', not 'T' and a number");
        }
        return temperature;
    }

private:
    SerialLine(const std::string& path, int file) : path_{path}, file_{file} {
        if (file_ < 0) refuse(std::strerror(errno));
    }
    std::string readLine() const {
        std::string line;
        for (char next = 0; line.size() < longestLine;) {
            pollfd answer{file_, POLLIN, 0};
            if (poll(&answer, 1, answerTime) <= 0) refuse("no answer for 200 ms");
            if (read(file_, &next, 1) != 1) refuse("the oven is gone");
            if (next == '\n') return line;
            line += next;
        }
        refuse("its answer has no end");
    }
    [[noreturn]] void refuse(const std::string& why) const {
        throw std::runtime_error(path_ + ": " + why);
    }

    static constexpr std::size_t longestLine = 40;
    static constexpr int answerTime = 200;  // ms
    std::string path_;
    int file_;
};

struct Reading {
    double temperature = 0;
};
struct Wish {
    double power = 0;
};

class Oven final : public cortex::cs::IoSimplex<Reading, Wish> {
public:
    using IoSimplex::IoSimplex;

private:
    void populate() override {
        power_ = input("heater").data<double>("power", "W");
        safePower_ = input("heater").safeValue<double>("power", "W");
        temperature_ = output("inside").data<double>("temperature", "Cel");
        port_ = data<const std::string_view>("port").get();
        loseAfter(500ms);
    }

    // In the tick. A lost oven keeps the temperature that it had, with the quality `lost`.
    void loopEnd(const Tick&) CORTEX_REALTIME override {
        if (!isLost()) temperature_ = received().temperature;
        give({inputLost() ? safePower_ : power_.get()});  // nobody speaks for the demand any more
    }

    // On a thread of its own: whatever goes wrong, it connects anew after a while.
    void communicate(Line& line) override {
        do {
            try {
                const SerialLine serial{port_};
                do {
                    line.put({serial.exchange(wished(line))});
                } while (line.waitFor(20ms));
                serial.exchange(wished(line));  // the loop has waited: it is safe
            } catch (const std::runtime_error& error) {
                line.lose(error.what());
            }
        } while (line.waitFor(200ms));
    }

    static double wished(Line& line) {
        const Wish* wish = line.demand();
        const bool isFresh = wish != nullptr && line.demandAge() < 1s;
        return isFresh ? wish->power : 0;  // a loop that hangs must not heat
    }

    Data<const double> power_;
    Data<double> temperature_;
    double safePower_ = 0;
    std::string port_;
};

class OvenController final : public cortex::cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    void populate() override {
        temperature_ = input("inside").data<double>("temperature", "Cel");
        power_ = output("heater").data<double>("power", "W");
        wanted_ = data<double>("wanted", "Cel");
        gain_ = data<double>("gain", "W/K");
    }
    void stateActive(const Tick&) CORTEX_REALTIME override {
        power_ = std::clamp(gain_ * (wanted_ - temperature_), 0.0, 2000.0);
    }
    Data<const double> temperature_;
    Data<double> power_, wanted_, gain_;
};

void addClasses(cortex::ClassRegistry& registry) {
    registry.add<Oven>("Oven");
    registry.add<OvenController>("OvenController");
}

}  // namespace

CORTEX_PLUGIN(addClasses, {"Oven", ""}, {"OvenController", ""})
