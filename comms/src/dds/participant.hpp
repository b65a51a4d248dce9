// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "dds/topics.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cortex::comms {

class SecurityIdentity;

// Writes messages to one topic. It is used and destroyed before its participant. Any thread.
template <class M>
class Writer {
public:
    ~Writer();

    bool write(const M& message);  // false: nothing was written
    bool dispose(const M& message)
        requires Keyed<M>;  // of a written sample; only the key counts
    std::uint32_t readers() const;

private:
    friend class Participant;
    struct Impl;
    explicit Writer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

// Passes on what arrives on one topic. The callbacks run on threads of DDS, one at a time. None
// begins or runs after the destructor, which must not be called from a callback. It is destroyed
// before its participant.
template <class M>
class Reader {
public:
    ~Reader();

    // Participants that write it, without those that are silent.
    std::uint32_t writers() const;
    std::uint32_t unheard() const;  // of those: nothing of them was passed on
    // One of them was heard and is no more, though it goes on: this reader skips what it writes.
    bool isDeaf() const;

private:
    friend class Participant;
    struct Impl;
    explicit Reader(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

// The membership of an agent or a tool in a domain; the only class that knows Fast DDS. The
// constructor, writer() and reader() throw Error. One thread at a time.
class Participant {
public:
    enum class Speaks { AtOnce, WhenTold };

    // The others learn in one message what was made and written before speak(). What is made later
    // costs an exchange with each of them.
    Participant(const NetworkOptions& options, const std::string& name,
                Speaks speaks = Speaks::AtOnce);
    Participant(Participant&& other) noexcept;
    ~Participant();

    template <class M>
    std::unique_ptr<Writer<M>> writer(const Topic& topic);

    void speak();
    // Drops everything that arrives from now on. To be called before the endpoints are destroyed.
    void stopListening();

    // A callback should only take the sample and return: nothing else arrives while it runs. A key
    // that never had a sample may be disposed too.
    template <class M>
    std::unique_ptr<Reader<M>> reader(const Topic& topic, std::function<void(M&&)> onSample,
                                      std::function<void(const Id&)> onDisposed = {});

    // Fast DDS announces this participant every 3 s, or less often in a crowd. Calling this often,
    // while another participant may have forgotten us, announces it more often.
    void announce();

    // Leaves the network and goes on as `next`, which has joined it. All endpoints of this one are
    // destroyed before. identity() stays valid, and what it knew is known no more.
    void replaceBy(Participant&& next);

    std::uint64_t malformed() const;  // samples that did not decode, or at which a callback threw

    SecurityIdentity* identity() const;  // null: without security
    // What security and the filter of datagrams have refused since the last call, as sentences, and
    // how often since the start.
    std::vector<std::string> takeRefusals();
    std::uint64_t refused() const;
    struct Refused {
        std::uint64_t count = 0;
        std::string lastFrom;  // the address of the last sender; empty: it is not known
    };
    // By reason what refused() and malformed() count.
    std::map<std::string, Refused> refusals() const;
    std::string dropped() const;    // datagrams, by reason, in words; empty: none
    std::uint32_t pending() const;  // others that are not authenticated yet
    bool findsUnproven() const;     // one of them for longer than that takes
    std::uint32_t secured() const;  // others that ask for security

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cortex::comms
