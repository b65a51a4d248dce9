// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/toolkit/fieldbus_device.hpp"

#include "modbus_client.hpp"
#include "modbus_words.hpp"

#include <optional>

namespace cortex::modbus {

// In populate(), from the items of type ModbusDevice. Throws Error.
ModbusClient::Settings clientSettings(Simplex& device, const toolkit::LinkSettings& link);
WordOrder wordOrderOf(Simplex& device);

// A device behind Modbus/TCP, of a type that extends ModbusDevice (ontology/devices.xml). In place
// of connect(), exchange() and close() of FieldbusDevice it has the two functions below.
//
//     void populate() override { …; populateModbus(); }
template <class In, class Out>
class ModbusDevice : public toolkit::FieldbusDevice<In, Out> {
public:
    using toolkit::FieldbusDevice<In, Out>::FieldbusDevice;

protected:
    // On the thread, when the connection is there: who answers? Throws LinkRefused where that is
    // another device. It reads before it writes, and takes less than half a second together:
    // allow() what it needs.
    virtual void identify(ModbusClient&) {}
    // On the thread: all requests together have responseTimeout.
    virtual void talk(ModbusClient& client, const Out& demand, In& answer) = 0;

    // In populate().
    void populateModbus() {
        this->populateLink();
        client_.emplace(clientSettings(*this, this->settings()));
        wordOrder_ = wordOrderOf(*this);
    }
    WordOrder wordOrder() const CORTEX_REALTIME { return wordOrder_; }
    // For work at the device, on the thread: allow() its time first.
    ModbusClient& client() { return *client_; }

private:
    void connect() final {
        client_->connect();
        identify(*client_);
    }
    void exchange(const Out& demand, In& answer) final {
        client_->allow(this->settings().responseTimeout);
        talk(*client_, demand, answer);
    }
    void close() noexcept final { client_->close(); }

    std::optional<ModbusClient> client_;
    WordOrder wordOrder_ = WordOrder::HighWordFirst;
};

}  // namespace cortex::modbus
