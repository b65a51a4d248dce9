// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace cortex::test {

// Why this machine has no network namespaces for a test; empty: it has.
std::string whyNoHosts();
std::string whyNoRelay();  // the same of the cards that DelayedHosts needs

// A host of its own as far as network and host name go: namespaces that end with this object.
// Threads and programs that are started within stay within.
class Host {
public:
    explicit Host(const std::string& name);
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    void within(const std::function<void()>& function) const;  // throws what the function throws
    std::string command(const std::string& line) const;        // of the shell; throws if it fails
    std::string path() const;  // of the namespace of the network, for `ip`

private:
    int network_ = -1, name_ = -1;
};

// Two hosts, 10.77.0.1 and 10.77.0.2, joined by a pair of virtual network cards.
class TwoHosts {
public:
    TwoHosts();

    void cut() { second.command("ip link set eth0 down"); }
    void join() { second.command("ip link set eth0 up"); }
    void losePercent(int percent);  // of what comes in, on both
    void loseAll();
    void dropMulticast();
    void passAll();
    // Questions about names get no answer, as in a plant whose name service cannot be reached.
    void silenceNames();
    int askedForNames() const;  // since then, by both

    Host first{"first"}, second{"second"};

private:
    void filter(const std::string& rule);
};

// The same joined by a relay of whole frames, each of which takes 10 to 30 ms: later ones overtake.
class DelayedHosts {
public:
    DelayedHosts();
    ~DelayedHosts();

    std::uint64_t frames() const { return frames_; }
    std::uint64_t overtaken() const { return overtaken_; }

    Host first{"first"}, second{"second"};

private:
    void relay();

    int taps_[2];
    std::atomic<bool> stop_{false};
    std::atomic<std::uint64_t> frames_{0}, overtaken_{0};
    std::thread thread_;
};

}  // namespace cortex::test
