// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gripper/robotiq_registers.hpp"
#include "modbus_device.hpp"

#include <array>
#include <chrono>
#include <cstdint>

namespace cortex::modbus {

struct RobotiqAnswer {
    RobotiqStatus status;
    std::int64_t time = 0;          // ns of the monotonic clock, when it was read
    std::uint32_t activations = 0;  // how often a startup had seen to it that it is activated
};

struct RobotiqDemand {
    RobotiqRequest request;
    bool isWished = false;  // otherwise the gripper keeps what it was told last
};

// Class of type RobotiqModbusGripper (ontology/grippers.xml): docs/modbus.md.
class RobotiqModbusGripper final : public ModbusDevice<RobotiqAnswer, RobotiqDemand> {
public:
    using ModbusDevice::ModbusDevice;

private:
    // Of an answer.
    struct Place {
        double width = 0;
        std::int64_t time = 0;
        void keep(Archive& archive) CORTEX_REALTIME { archive & width & time; }
    };

    void populate() override;
    void populateItems();
    void identify(ModbusClient& client) override;
    void talk(ModbusClient& client, const RobotiqDemand& demand, RobotiqAnswer& answer) override;
    RobotiqStatus read(ModbusClient& client);
    void activate();

    void stateStandby(const Tick&) CORTEX_REALTIME override { isAsked_ = false; }
    bool stateStartingUp(const Tick&) CORTEX_REALTIME override;
    void stateActive(const Tick&) CORTEX_REALTIME override;
    void pack(RobotiqDemand& demand) CORTEX_REALTIME override;
    void quiet(RobotiqDemand&) CORTEX_REALTIME override;
    void unpack(const RobotiqAnswer& answer) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    double demandAway() const CORTEX_REALTIME;  // m, from the fingers; infinite while it moves
    bool waitsForDemand(double seconds) CORTEX_REALTIME;
    bool letsStand(std::uint8_t position) const CORTEX_REALTIME;
    std::int64_t axisStatus(const RobotiqStatus& status) const CORTEX_REALTIME;
    std::int64_t objectOf(const RobotiqStatus& status) const CORTEX_REALTIME;
    double speedTo(const Place& place) CORTEX_REALTIME;
    bool failsBy(const RobotiqStatus& status) CORTEX_REALTIME;

    RobotiqScale scale_;
    const SlotState* demandSlot_ = nullptr;
    Data<const double> wishedWidth_, wishedSpeed_, wishedForce_;
    Data<double> position_, velocity_, current_;
    Data<std::int64_t> status_, object_, activation_, gripperFault_;

    cs::SlowWork activating_;
    std::uint32_t activations_ = 0;  // the thread's: how often that was done

    RobotiqRequest last_;            // that was wished
    std::array<Place, 4> places_{};  // the oldest first
    std::uint32_t activationsSeen_ = 0;
    std::uint8_t toldFault_ = 0;
    bool isAsked_ = false;    // for the activation of this startup
    bool hasJoined_ = false;  // its demand has stood at the fingers
    bool isLed_ = false;      // a controller has been Active since it is
    double waited_ = 0;       // s, in the startup, for such a demand
    bool isMoving_ = false;   // the demand
    bool isWished_ = false;   // last_ is on its way, or has come
};

}  // namespace cortex::modbus
