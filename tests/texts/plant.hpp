// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include "cli/live_agent.hpp"
#include "comms/inbox.hpp"
#include "processes/agent_process.hpp"
#include "texts/random_model.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cortex::test {

// What an agent needs for these types.
inline const std::vector<std::string> withCarrier{"--plugin",
                                                  CORTEX_BINARY_DIR "/lib/plugins/carrier.so"};

// Files with these types, which extend `Carrier`: it copies items, and its command `echo` answers
// what it is asked.
void writeTypes(const ModelFolder& folder, const std::string& types);

std::size_t countOf(const AllValues& values);  // items
// How many of the second are others than the first has, bit by bit.
std::size_t otherThan(const AllValues& all, const AllValues& values);
// Those of the first that the second has.
AllValues someOf(const AllValues& all, const AllValues& wanted);
void replaceBy(AllValues& values, const AllValues& others);

// The value of an item as JSON has it: one element, or a list. None: it is of another kind.
std::optional<Value> valueOf(const DataItem& item, const nlohmann::json& written);

// The two agents of a random model, a mirror that sees both, and the tools. What compares returns
// "", or the first differences in words.
class Plant {
public:
    Plant(Chance& chance, std::size_t types, std::size_t simplexes);

    std::string seen(const AllValues& expected);         // by the mirror; waits for it
    std::string copied(const AllValues& first);          // by the second agent; waits for it
    std::string shown(const AllValues& expected) const;  // by `cortex show --json`
    // By `cortex save` in this file, which has these and no others.
    std::string saved(const std::string& name, const AllValues& expected) const;
    nlohmann::json restored(const std::string& name) const;
    // Sets them: of every second simplex by `cortex set`, of the others by the mirror.
    std::string set(Chance& chance, const AllValues& values);
    // By `cortex call`, whose command answers what it was asked.
    std::string echoed(Chance& chance) const;
    // `cortex set` of what no value can be is refused.
    void refusesToSet() const;
    // Starts the first agent again, which goes on with its retained values and this file.
    void startAgain(const std::string& settings);

    std::string output() const { return first_->output() + second_->output(); }

private:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::optional<Value> valueIn(const std::string& path, const std::string& item) const;

    const ModelFolder folder_;

public:
    const RandomModel model;

private:
    comms::Mirror mirror_{"texts", comms::loopback()};
    std::filesystem::path system_;
    std::optional<AgentProcess> first_, second_;
    std::uint64_t images_ = 0;
};

}  // namespace cortex::test
