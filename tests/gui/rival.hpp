// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/dds_interface.hpp"
#include "cortex/core/clock.hpp"

#include "support/probe.hpp"

#include <chrono>

namespace cortex::test {

// An agent of this process, "rival", that has /drive, as the agent of the window's tests has.
class Rival {
public:
    explicit Rival(const comms::NetworkOptions& on, bool fails = false) {
        cluster_.trigger = nullptr;
        cluster_.cluster->setTriggerSource<cs::InternalClock>(std::chrono::milliseconds{5});
        cluster_.cluster->addInterface<comms::DdsInterface>(on);
        Probe& drive = cluster_.probe("/drive");
        if (fails) {
            drive.onStandby = [](Probe& probe, const Tick&) {
                probe.fault(7, "the axis does not follow");
            };
        }
        cluster_.start();
    }
    ~Rival() { cluster_.cluster->stop(); }  // before its hooks go
    Rival(const Rival&) = delete;
    Rival& operator=(const Rival&) = delete;

private:
    ProbeCluster cluster_{{}, "rival"};
};

}  // namespace cortex::test
