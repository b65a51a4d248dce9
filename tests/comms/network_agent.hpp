// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/dds_interface.hpp"

#include "comms/inbox.hpp"
#include "dds/participant.hpp"
#include "support/agent_rig.hpp"
#include "wire/ids.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cortex::comms {

// Types of the command tests, one of them changed.
TypeModel changedTypes(const std::string& type, const std::function<void(DataItem&)>& change);

// An agent on the network of this process; the test steps it.
struct NetworkAgent {
    explicit NetworkAgent(const std::string& name) : NetworkAgent{test::commandTypes(), name} {}
    NetworkAgent(TypeModel types, const std::string& name, AgentOptions options = {})
        : rig{std::move(types), name, options} {
        rig.add(dds);
    }
    NetworkAgent(const std::string& name, NetworkOptions network, AgentOptions options = {})
        : dds{std::move(network)}, rig{test::commandTypes(), name, options} {
        rig.add(dds);
    }

    const Structure& structure() const { return rig.agent->structure(); }
    bool sees(std::string_view event) {
        return comesTrue([&] {
            rig.step();
            return rig.hasEvent(event);
        });
    }

    DdsInterface dds{loopback()};
    test::AgentRig rig;
};

// A participant of the test's own: says whatever the test wants and collects what comes back.
class RawTool {
public:
    explicit RawTool(std::string name, const NetworkOptions& options = loopback());

    Presence presence(const std::string& state = "running") const;
    Interest interest(Interest wanted) const;
    Command command(const Structure& target, const std::string& path, const std::string& name,
                    std::vector<NamedValue> arguments = {});
    // Waits until so many agents listen, and are heard.
    void connect(std::uint32_t agents = 1);

    std::string name;
    std::int64_t epoch = 1'700'000'000'000'000;
    Participant participant;
    std::unique_ptr<Writer<Presence>> presences;
    std::unique_ptr<Writer<Model>> models;
    std::unique_ptr<Writer<Interest>> interests;
    std::unique_ptr<Writer<Command>> commands;
    Inbox<Presence> heard;
    Inbox<Answer> answers, greetings;
    std::unique_ptr<Reader<Presence>> presenceReader;
    std::unique_ptr<Reader<Answer>> answerReader;

private:
    // Sends those that were heard and did not answer yet a command that they do not know; the
    // number of those that did.
    std::size_t greet();

    std::uint64_t sequence_ = 0;
};

}  // namespace cortex::comms
