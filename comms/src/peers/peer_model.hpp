// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/report.hpp"
#include "cortex/core/structure.hpp"

#include "wire/messages.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace cortex::comms {

// What is known of one agent (or tool) in one epoch: its presence, types and simplexes, from
// samples in any order, and the structure that they make. Nothing said by others is believed
// unchecked; what is refused is counted. Used under its owner's mutex.
class PeerModel {
public:
    PeerModel(std::string agent, std::int64_t epoch);

    const std::string& agent() const { return agent_; }
    std::int64_t epoch() const { return epoch_; }

    // False: refused and counted.
    bool add(const Presence& presence);
    bool add(const Model& model);

    const std::optional<Presence>& presence() const { return presence_; }
    bool has(const std::string& path) const { return simplexes_.contains(path); }
    std::uint32_t missing() const;  // types and simplexes that were announced and are not here
    bool complete() const;          // a presence is here, and all that it counts; hashes agree
    std::uint64_t refused() const { return refused_; }

    // With what is here now; built at the first call. Null until it is complete, for a tool, and if
    // it contradicts itself: findings() says how.
    std::shared_ptr<const Structure> structure();
    std::shared_ptr<const TypeModel> types();
    const Report& findings() const { return findings_; }

private:
    bool refuse();
    bool add(const TypeMessage& type);
    bool add(const SimplexMessage& simplex);
    void changed();
    bool hashesAgree() const;
    void build();

    std::string agent_;
    std::int64_t epoch_;
    std::optional<Presence> presence_;
    std::map<std::string, TypeMessage> types_;
    std::map<std::string, SimplexMessage> simplexes_;  // by path
    std::uint64_t refused_ = 0;
    mutable std::optional<bool> agreed_;  // hashes of what is here; none: not computed
    bool built_ = false;
    std::shared_ptr<const Structure> structure_;
    Report findings_;
};

}  // namespace cortex::comms
