// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstdint>
#include <string_view>

// What may be shown as the present value; everything else stands in brackets.
namespace cortex::common {

// Whether the framework writes this item, such as its state, in every simplex that has it; also
// where the type of the simplex states the item anew.
bool isOfFramework(const Structure& structure, std::uint32_t simplex, std::string_view item);

// Whether its agent itself tells this item, whatever becomes of what the simplex measures: what the
// framework writes, and what a FieldbusDevice knows of its link.
bool isOfAgent(const Structure& structure, std::uint32_t simplex, std::string_view item);

// Whether this item stands for nothing yet: a FieldbusDevice that has never answered cannot say how
// old its answer is, and nothing of its observations was ever measured. False where the values of
// the device are not in the image, as nobody asked for them.
bool neverCame(const comms::AgentImage& image, std::uint32_t simplex, const DataItem& item);
// The same of all that an observation says.
bool neverMeasured(const comms::AgentImage& image, std::uint32_t simplex);

// Its loop runs, as far as was heard of late.
bool runs(const comms::AgentStatus& agent);

// Whether what the framework writes of this simplex is the present value. It is as good as the last
// cycle that was heard, also where the simplex itself writes nothing, as in Standby.
bool isHeard(const comms::AgentStatus& agent, const comms::AgentImage& image,
             std::uint32_t simplex);
// The same of what the simplex writes itself, or is written into it: it is good, or a safe demand
// (`safe`, by safeBecause()).
bool isLive(const comms::AgentStatus& agent, const comms::AgentImage& image, std::uint32_t simplex,
            bool safe);
// The same of any item. A constant is always live.
bool isLive(const comms::AgentStatus& agent, const comms::AgentImage& image, std::uint32_t simplex,
            bool safe, const DataItem& item);

}  // namespace cortex::common
