// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/archive.hpp"
#include "cortex/cs/simplex_cs.hpp"

#include <cstdint>
#include <vector>

namespace cortex::toolkit {

// Says whether all that it watches is good and young, and whether an item of each moves on.
class Watchdog final : public cs::SimplexCS {
public:
    using SimplexCS::SimplexCS;

private:
    enum class Moves : std::uint8_t { Nothing, Count, Number };  // what has to
    struct Watched {
        const SlotState* state;
        // Of the item that must change: the one that `moves` names.
        Data<const std::int64_t> count;
        Data<const double> number;
        Moves moves = Moves::Nothing;
        double last = 0;
        std::int64_t changedAt = 0;  // ns

        void keep(Archive& archive) { (archive & last).time(changedAt); }
    };
    void populate() override;
    bool stateStartingUp(const Tick& tick) override;
    void stateActive(const Tick& tick) override;
    void keep(Archive& archive) override;

    bool isAlive(Watched& watched, std::int64_t now) CORTEX_REALTIME;
    static double numberOf(const Watched& watched) CORTEX_REALTIME;

    std::vector<Watched> watched_;
    Data<const double> timeout_;
    Data<double> lastChange_;
    Data<std::int64_t> failing_;
    Data<bool> ok_;
};

}  // namespace cortex::toolkit
