// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/cs/simplex_cs.hpp"
#include "cortex/drives/ds402_drive.hpp"
#include "cortex/toolkit/fieldbus_link.hpp"

#include "ds402/drive_items.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cortex::toolkit {

// A CiA 402 drive with one or two axes as a model in this process. It is stepped in each cycle, in
// every state of its own, and the same at each run. Each step counts as an exchange.
class Ds402SimulatedDrive final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    struct Axis {
        Ds402DemandItems demand;
        Ds402ObservationItems observation;
        drives::Ds402Drive drive;
        bool refuses = false;  // what it is to be set to
    };

    void populate() override;
    bool stateStartingUp(const Tick& tick) CORTEX_REALTIME override;
    void settingsProposed(ProposedSettings& proposed) CORTEX_REALTIME override;
    void loopEnd(const Tick& tick) CORTEX_REALTIME override;
    void keep(Archive& archive) CORTEX_REALTIME override;

    Outcome injectFault(Call& call) CORTEX_REALTIME;
    Outcome jumpEncoder(Call& call) CORTEX_REALTIME;
    Outcome reconnect(Call& call) CORTEX_REALTIME;

    drives::Ds402Parameters parametersOf(std::size_t place, const OutputSimplex& observation);
    void set(std::size_t place) CORTEX_REALTIME;
    Axis* named(Call& call, Argument<std::int64_t> axis) CORTEX_REALTIME;

    std::vector<Axis> axes_;
    std::span<const double> load_, friction_;  // % of the rated effort
    std::span<const double> stops_;            // least and greatest place of each axis
    Argument<std::int64_t> faultAxis_, faultCode_, jumpAxis_;
    Argument<double> jumpBy_;
    LinkItems items_;
    LinkReport report_;
};

}  // namespace cortex::toolkit
