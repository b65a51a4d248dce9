// SPDX-License-Identifier: Apache-2.0
// An oven behind a serial line, as a plug-in for cortex-agent: the line blocks, the tick does not.
// The program writes "H 350.0", heater at 350 W; the oven answers "T 81.25", 81.25 degrees inside.
#include "cortex/core/registry.hpp"
#include "cortex/toolkit/fieldbus_device.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace {

using cortex::Data;
using cortex::Tick;
using cortex::toolkit::FieldbusDevice;
using cortex::toolkit::LinkError;

// One connection to the oven; it blocks, and throws when the oven is away or answers nonsense.
class SerialLine {
public:
    SerialLine(const std::string& path, std::chrono::milliseconds answerTime)
        : SerialLine{path, answerTime, open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)} {
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
    SerialLine(const std::string& path, std::chrono::milliseconds answerTime, int file)
        : path_{path}, answerTime_{static_cast<int>(answerTime.count())}, file_{file} {
        if (file_ < 0) refuse(std::strerror(errno));
    }
    std::string readLine() const {
        std::string line;
        for (char next = 0; line.size() < longestLine;) {
            pollfd answer{file_, POLLIN, 0};
            if (poll(&answer, 1, answerTime_) <= 0)
                refuse("no answer for " + std::to_string(answerTime_) + " ms; is the oven on?");
            if (read(file_, &next, 1) != 1) refuse("the oven is gone");
            if (next == '\n') return line;
            line += next;
        }
        refuse("its answer has no end");
    }
    [[noreturn]] void refuse(const std::string& why) const { throw LinkError(path_ + ": " + why); }

    static constexpr std::size_t longestLine = 40;
    std::string path_;
    int answerTime_;  // ms
    int file_;
};

struct Reading {
    double temperature = 0;
};
struct Wish {
    double power = 0;
};

class Oven final : public FieldbusDevice<Reading, Wish> {
public:
    using FieldbusDevice::FieldbusDevice;

private:
    void populate() override {
        power_ = input("heater").data<double>("power", "W");
        safePower_ = input("heater").safeValue<double>("power", "W");
        temperature_ = output("inside").data<double>("temperature", "Cel");
        populateLink();
    }

    // On a thread of its own. Whatever goes wrong, it is closed and connected anew after a while.
    void connect() override {
        line_.emplace(settings().address, std::chrono::duration_cast<std::chrono::milliseconds>(
                                              settings().responseTimeout));
    }
    void exchange(const Wish& wish, Reading& reading) override {
        reading.temperature = line_->exchange(wish.power);
    }
    void close() noexcept override { line_.reset(); }

    // In the tick. A lost oven keeps the temperature that it had, with the quality `lost`.
    void unpack(const Reading& reading) CORTEX_REALTIME override {
        temperature_ = reading.temperature;
    }
    void pack(Wish& wish) CORTEX_REALTIME override { wish.power = power_; }
    // Nobody speaks for the demand any more, or the loop hangs.
    void quiet(Wish& wish) CORTEX_REALTIME override { wish.power = safePower_; }

    Data<const double> power_;
    Data<double> temperature_;
    double safePower_ = 0;
    std::optional<SerialLine> line_;  // of the thread
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
