// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror_data.hpp"
#include "cortex/comms/mirror_listening.hpp"
#include "cortex/comms/network_options.hpp"
#include "cortex/core/program_interface.hpp"
#include "cortex/core/structure.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cortex::comms {

// All agents of a domain for tools: their models, values, events and commands, without any prior
// knowledge of them. It has a thread of its own, and any thread may call it. What nobody asks for
// is neither subscribed to nor decoded.
class Mirror {
public:
    using Arguments = ProgramInterface::Arguments;
    using Milliseconds = std::chrono::milliseconds;
    static constexpr Milliseconds usualQuiet{100};   // in which nobody new appears
    static constexpr Milliseconds timeToMeet{2000};  // in which who may own the same path is heard

    // Host and process are appended to the name, so that each instance has its own. Throws Error
    // with a remedy if the network cannot be used.
    explicit Mirror(const std::string& tool, const NetworkOptions& options = {});
    ~Mirror();

    const std::string& name() const;  // as agents see it: the holder of its control leases

    std::vector<AgentStatus> agents() const;  // by name; without those lost for more than a minute
    std::uint32_t unheard() const;   // agents that another agent hears and this mirror does not
    std::uint32_t nameless() const;  // found on the network, and have not said yet who they are
    // Participants with security that were found, while this mirror has none: it cannot see more.
    std::uint32_t closed() const;
    // Waits until at least one agent is present, everything of all has come, all whom they hear are
    // known here, and no new one has appeared for a while. False: not within `limit`.
    bool waitUntilComplete(Milliseconds limit, Milliseconds quiet = usualQuiet) const;
    // Null until everything of the agent has come. A later start has a structure of its own.
    std::shared_ptr<const Structure> structure(const std::string& agent) const;
    // The agent that owns this simplex: of several by signed right, otherwise the one that was
    // there first (docs/protocol.md). One that is heard comes before those that are lost.
    std::optional<std::string> ownerOf(std::string_view path) const;
    // The same as soon as nobody else who is heard may own it; `others` after everything of it has
    // come at the latest. None: everything has come, nobody new has appeared for a while and nobody
    // who is heard owns it, or `limit` is over.
    std::optional<std::string> waitForOwner(std::string_view path, Milliseconds limit,
                                            Milliseconds quiet = usualQuiet,
                                            Milliseconds others = timeToMeet) const;
    std::vector<Contested> contested() const;  // sorted by path

    // Receives from now on the values of all simplexes at and below these paths, at this rate or
    // more (images per second; 0: every cycle). It replaces the last call. No paths: no values.
    void view(std::vector<std::string> prefixes, std::uint32_t rate = 30);
    // The same with a rate for each set of paths. A simplex below several gets the fastest rate.
    void view(const std::vector<Viewed>& views);
    // Waits until every agent that is present has sent everything that is viewed at least once.
    bool waitForValues(Milliseconds limit) const;
    // The newest image; empty if nothing of the agent is viewed. Simplexes that are not viewed, or
    // have not come, have the quality `lost`. Those that should have come again have `stale`.
    AgentImage image(const std::string& agent) const;
    // Reports each image that an agent sends, in order and before the next is taken in. The
    // listener runs on the mirror's thread, one call after the other and none under a mutex of the
    // mirror: it copies what it needs, does not throw, and returns soon, as nothing is received
    // meanwhile. What it captures must live until stop() of what is returned has returned, or until
    // the mirror is destroyed. Throws std::invalid_argument for an empty function. Images that were
    // lost on the way are counted in AgentStatus::loss; of a view of every cycle they show as a gap
    // in the cycles. With several rates the cycle is that of the fastest one: an image that repeats
    // it has new values of slower ones.
    Listening onImage(std::function<void(const std::string& agent, const AgentImage&)> listener);
    // Asks all agents from now on how all their simplexes are, five times a second, in an octet of
    // each: much less than their values. False: no longer.
    void viewSummary(bool wanted = true);
    // How they are, by the index of the simplex; empty: nothing has come, or nobody asked for it.
    // Of an agent that cannot say so (AgentStatus::summarises) it follows from what is viewed.
    std::vector<SimplexMark> summary(const std::string& agent) const;
    // Seconds since the measurement; of what no task writes, since the cycle that came. None: no
    // values have come.
    std::optional<double> age(const std::string& agent, std::uint32_t simplex) const;
    // The same for every simplex at one instant, by its index. Empty: nothing of it is viewed.
    std::vector<std::optional<double>> ages(const std::string& agent) const;
    // Waits until all agents together have published more than `last` images, and returns their
    // number.
    std::uint64_t waitForImage(std::uint64_t last, Milliseconds limit) const;

    // Tells all agents, also those that come later, that this tool may command soon. Then the first
    // command, which may be a stop, is answered as quickly as the next ones. Otherwise both sides
    // begin to make what answers need with the first command.
    void prepareCommands();
    // From now on its commands say that they are on behalf of this person or program (at most 31
    // bytes; empty: of the tool itself). Events and answers say it again; no right follows from it.
    // Throws Error for a longer name or one with control characters.
    void actFor(const std::string& person);
    // From now on tells all others who uses this tool: a person who may hold control in it. Throws
    // Error unless it is a text of 1 to 63 bytes of UTF-8 without control characters and brackets
    // ( ), and without a blank at either end.
    void introduce(const std::string& person);
    // The others that say who uses them and are heard, by name. Those that another one replaces
    // under its name, or that say nothing for four times their interval, are left out.
    std::vector<ToolStatus> tools() const;
    // What this tool asks for from now on, and what it refuses others: eight at most reach them.
    // LeaseClient says both. Throws Error as LeaseClient::ask() does.
    void tellAsks(const ControlAsk& asks,
                  std::vector<std::pair<std::string, std::uint64_t>> refuses);

    // Sends a command. It expires if the agent has not read it within `budget` of the agent's time.
    // The number identifies the answer. Throws Error for unknown paths, commands and parameters,
    // and for values of the wrong kind. The agent checks states and ranges.
    std::uint64_t send(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds budget = std::chrono::seconds{5});
    bool poll(std::uint64_t number, CommandAnswer& answer);  // once; Running is not an answer
    bool waitForAnswer(std::uint64_t number, CommandAnswer& answer, Milliseconds limit);
    void abandon(std::uint64_t number);  // nobody will fetch the answer
    CommandAnswer call(std::string_view path, std::string_view command,
                       const Arguments& arguments = {},
                       Milliseconds timeout = std::chrono::seconds{5});

    // Reports the events of all agents, the last 1,000 of each first, unless a listener was there
    // before: it gets those from now on. All else is as with onImage().
    Listening onEvent(std::function<void(const AgentEvent&)> listener);
    // Whether all events have come that the present agents say they have written. They say so ten
    // times a second.
    bool eventsComplete() const;

    // Asks an agent for what it has kept of a time that is over (UTC ns by its clock, both ends
    // included). The number identifies the answer. Several asks wait for one another.
    std::uint64_t askPast(const std::string& agent, std::int64_t from, std::int64_t until);
    // Once: everything has come, or PastEvents::trouble says why not. An agent has 5 s for each
    // part of it.
    bool pollPast(std::uint64_t number, PastEvents& past);
    // What has come of it, the oldest first; nobody will fetch the rest.
    PastEvents abandonPast(std::uint64_t number);

    std::uint64_t refused() const;  // samples that were malformed or impossible
    // What this mirror's own gate has not let in, by the reason: "datagrams: a submessage …".
    std::map<std::string, Refused> refusals() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
