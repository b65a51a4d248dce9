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
#include <vector>

namespace cortex::comms {

// What one agent or tool has published in one epoch: its presence, types and simplexes, from
// samples in any order, and the structure that they make. Everything is checked, and what is
// refused is counted. Used under the mutex of its owner.
class PeerModel {
public:
    PeerModel(std::string agent, std::int64_t epoch);

    const std::string& agent() const { return agent_; }
    std::int64_t epoch() const { return epoch_; }

    // False: the sample was refused and counted.
    bool add(const Presence& presence);
    bool add(const Model& model);

    const std::optional<Presence>& presence() const { return presence_; }
    // The signed list that its first sample shows; empty without security.
    const std::string& authority() const { return authority_; }
    bool has(const std::string& path) const { return simplexes_.contains(path); }
    std::vector<std::string> paths() const;
    std::uint32_t missing() const;  // types and simplexes that were announced and have not come
    std::uint32_t missingTypes() const;
    // Types that others name and that have not come; at most as many as are told.
    std::vector<std::string> missingNames() const;
    static constexpr std::size_t mostNames = 5;
    bool complete() const;  // everything that the presence counts has come; hashes agree
    std::uint64_t refused() const { return refused_; }

    // Built at the first call from what has come. Null until it is complete, for a tool, and where
    // the model contradicts itself; then findings() has the reason.
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
    std::string authority_;
    std::uint64_t refused_ = 0;
    mutable std::optional<bool> agreed_;  // whether the hashes agree; none: not computed yet
    bool built_ = false;
    std::shared_ptr<const Structure> structure_;
    Report findings_;
};

}  // namespace cortex::comms
