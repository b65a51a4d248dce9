// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::comms {

// A control lease as its agent shows it among its own data.
struct ShownLease {
    std::string agent, prefix, holder;
    std::int64_t since = 0;  // UTC ns
    double seconds = 0;      // since then, in the agent's own time
    std::int64_t cycle = 0;  // of the agent, in which it was taken or handed over
};

// By prefix. Empty: nothing is held, or the agent's own simplex is not viewed.
std::vector<ShownLease> leasesOf(const AgentStatus& agent, const AgentImage& image);

// Whether a command of an agent keeps its leases: a tool sends these itself.
bool isControlCommand(std::string_view command);
// Whether it may be sent without a lease (docs/leases.md).
bool isFreeCommand(std::string_view command);

// The control leases of one mirror. A thread of its own asks for them, renews them twice a second,
// notices that one is lost, and accepts those that are handed over to us. Nothing waits but wait()
// and the end, which releases all within a second. Any thread.
class LeaseClient {
public:
    struct Lease {
        std::string agent, prefix;
        std::int64_t since = 0;  // UTC ns
    };
    struct Answer {
        std::string agent;
        CommandAnswer answer;  // Unknown: none came within 3 s
    };
    using Answers = std::vector<Answer>;
    // What the user of another tool asks us for.
    struct Asked {
        std::string tool, person, prefix;
        std::uint64_t number = 0;  // of that tool
        std::vector<Lease> gives;  // what we would hand over: never empty
    };
    // Somebody who holds a part of what we ask for.
    struct Holder {
        std::string name;          // of a tool or an agent
        std::string person;        // who uses it; empty: it does not say so, and cannot be asked
        std::vector<Lease> holds;  // of what we ask for
        bool refused = false;      // to us
    };
    // What we ask for, and whom; empty prefix: nothing.
    struct Asking {
        std::string prefix;
        std::vector<Holder> holders;  // by name; those who gave it away or lost it are no more
    };

    explicit LeaseClient(Mirror& mirror);
    ~LeaseClient();
    LeaseClient(const LeaseClient&) = delete;
    LeaseClient& operator=(const LeaseClient&) = delete;

    // Each returns at once with a number, by which poll() and wait() give the answers.
    // From all of these agents or from none: what some have granted is then released again.
    std::uint64_t take(const std::string& prefix, const std::vector<std::string>& agents);
    // What is held from these agents with exactly this prefix; no agents: from all. It is not
    // renewed from now on, whatever they answer.
    std::uint64_t release(const std::string& prefix, const std::vector<std::string>& agents = {});
    // The same leases go to another tool or agent, and what is held further down with them. No
    // agents: those of all.
    std::uint64_t handOver(const std::string& prefix, const std::string& to,
                           const std::vector<std::string>& agents = {});
    bool poll(std::uint64_t number, Answers& answers);  // once
    Answers wait(std::uint64_t number);                 // at most 3 s

    std::vector<Lease> held() const;  // in the order in which they were taken
    bool covers(std::string_view agent, std::string_view path) const;

    // Who holds a part of what lies at and below this prefix, ourselves left out. The agents' own
    // simplexes must be in the mirror's view, as for all that follows.
    std::vector<Holder> holdersOf(const std::string& prefix) const;
    // Asks them all for it; what was asked for before is withdrawn. It ends when nobody else holds
    // a part of it, when all who can be asked have refused, after two minutes, or with withdraw();
    // news() says what became of it. Asked for again meanwhile, it goes on. Throws Error unless the
    // prefix is "/" or a path of at most 127 bytes, and unless Mirror::introduce() was called.
    void ask(const std::string& prefix);
    void withdraw();
    Asking asking() const;
    // Who asks for something that we hold a part of, and got no answer yet: the longest first. An
    // ask counts once it has stood for 0.3 s.
    std::vector<Asked> asked() const;
    std::uint64_t grant(const Asked& asked);  // hands over what it gives; answers as handOver()
    void refuse(const Asked& asked);

    // From now on accepts what is handed over to us. `look` is called twice a second; it keeps the
    // agents' own simplexes in the mirror's view.
    void acceptOffers(std::function<void()> look);
    // False: leases end within 2 s. A program that does not answer its user must not hold a plant.
    void renew(bool renews);
    // What happened to leases without us, as sentences; each once.
    std::vector<std::string> news();

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::comms
