// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/transport.hpp"

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace cortex {

// The answer to a command.
struct CallResult {
    Outcome outcome = Outcome::None;
    Reason reason = Reason::None;
    std::string why;
    std::map<std::string, Value> response;
    std::int64_t latencyCycles = 0;

    bool done() const { return outcome == Outcome::Done; }
    std::string text() const;  // "Rejected (state): startup needs Standby, is Active"
};

// The program's own way in: commands to any simplex of its agent from any of its threads, as from
// outside. The loop's side is wait-free.
class ProgramInterface final : public CommunicationInterface {
public:
    explicit ProgramInterface(const std::string& sender = "program", std::uint32_t capacity = 64);
    ~ProgramInterface() override;

    // By parameter: {{"speed", 0.5}, {"name", "left"}, {"pose", std::vector{1.0, 2.0}}}.
    struct Arguments : std::map<std::string, Value> {
        Arguments() = default;
        Arguments(std::map<std::string, Value> all)
            : std::map<std::string, Value>(std::move(all)) {}
        Arguments(std::initializer_list<std::pair<std::string, GivenValue>> all) {
            for (const auto& [name, value] : all) emplace(name, value);
        }
    };
    // Sends; the sequence number identifies the answer. Throws Error for unknown paths, commands or
    // parameters and values of the wrong kind; ranges are checked by the receiver.
    std::uint64_t post(std::string_view path, std::string_view command,
                       const Arguments& arguments = {});
    // The answer if it has come; once. Running is not an answer.
    bool poll(std::uint64_t sequence, CallResult& result);
    // post() and wait; Unknown after the timeout.
    CallResult call(std::string_view path, std::string_view command,
                    const Arguments& arguments = {},
                    std::chrono::milliseconds timeout = std::chrono::seconds{5});

    void announce(const AgentAccess& agent) override;
    void read(Inbox& inbox) CORTEX_REALTIME override;
    void write(std::int64_t cycle, Outbox& outbox) CORTEX_REALTIME override;
    void close() override;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex
