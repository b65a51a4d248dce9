// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "dds/topics.hpp"
#include "wire/messages.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cortex::comms {

class SecurityIdentity;

// Writes messages to one topic; to be used and destroyed before its participant. Any thread.
template <class M>
class Writer {
public:
    ~Writer();

    bool write(const M& message);  // false: nothing was written
    bool dispose(const M& message)
        requires Keyed<M>;  // of what was written; only the key counts
    std::uint32_t readers() const;

private:
    friend class Participant;
    struct Impl;
    explicit Writer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

// Hands over what arrives on one topic, on threads of DDS, one call at a time. No call begins or
// runs after its destructor, which must not be called from one. Destroyed before its participant.
template <class M>
class Reader {
public:
    ~Reader();

    std::uint32_t writers() const;

private:
    friend class Participant;
    struct Impl;
    explicit Reader(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

// The membership of an agent or a tool in a domain; the only place that knows Fast DDS.
// Constructor, writer() and reader() throw Error; one thread at a time.
class Participant {
public:
    enum class Speaks { AtOnce, WhenTold };

    // What is made and written before it speaks is told to all who are there at once; what comes
    // one by one later costs them all a talk about each.
    Participant(const NetworkOptions& options, const std::string& name,
                Speaks speaks = Speaks::AtOnce);
    ~Participant();

    template <class M>
    std::unique_ptr<Writer<M>> writer(const Topic& topic);

    void speak();
    // All that others say from now on is dropped; before its endpoints are destroyed.
    void stopListening();

    // The callbacks should take the sample and return: while they run, nothing else arrives.
    // A key that was never heard may be disposed too.
    template <class M>
    std::unique_ptr<Reader<M>> reader(const Topic& topic, std::function<void(M&&)> onSample,
                                      std::function<void(const Id&)> onDisposed = {});

    // Others are told of us every 3 s or, in a crowd, more seldom; this, called often while
    // somebody is missed who may have forgotten us, does so more often.
    void announce();

    std::uint64_t malformed() const;  // samples that did not decode, or that a callback threw at

    SecurityIdentity* identity() const;  // null: without security
    // What security has refused since the last call, in words, and how often since the start.
    std::vector<std::string> takeRefusals();
    std::uint64_t refused() const;
    std::uint32_t pending() const;  // others that are not authenticated yet

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cortex::comms
