// SPDX-License-Identifier: Apache-2.0
#include "network/host.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <net/if.h>

namespace cortex::test {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno));
}

bool mayAdminister() {
    std::ifstream status{"/proc/self/status"};
    for (std::string word; status >> word;) {
        if (word != "CapEff:") continue;
        std::uint64_t capabilities = 0;
        status >> std::hex >> capabilities;
        constexpr std::uint64_t netAdmin = 1U << 12U, sysAdmin = 1U << 21U;
        return (capabilities & netAdmin) != 0 && (capabilities & sysAdmin) != 0;
    }
    return false;
}

// Runs in a thread of its own, which may change its namespace.
void aside(const std::function<void()>& function) {
    std::exception_ptr thrown;
    std::thread{[&] {
        try {
            function();
        } catch (...) {
            thrown = std::current_exception();
        }
    }}.join();
    if (thrown) std::rethrow_exception(thrown);
}

// A network card whose frames are read and written by this process.
int makeTap() {
    const int tap = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (tap < 0) fail("/dev/net/tun");
    ifreq request{};
    std::strcpy(request.ifr_name, "eth0");
    request.ifr_flags = IFF_TAP | IFF_NO_PI;
    if (ioctl(tap, TUNSETIFF, &request) != 0) fail("a tap device");
    return tap;
}

// A card that comes up a moment later is not seen by who looks once, as Fast DDS does.
void setUpCards(const Host& first, const Host& second) {
    first.command("ip address add 10.77.0.1/24 dev eth0 && ip link set eth0 up");
    second.command("ip address add 10.77.0.2/24 dev eth0 && ip link set eth0 up");
    for (const Host* host : {&first, &second}) {
        host->command(
            "timeout 60 sh -c 'until ip -br link show up dev eth0 | grep -q LOWER_UP &&"
            " ip -br link show dev eth0 | grep -qE \" (UP|UNKNOWN) \"; do sleep 0.02; done'");
    }
}

}  // namespace

std::string whyNoHosts() {
    if (!mayAdminister()) return "no right to make network namespaces (CAP_SYS_ADMIN)";
    int error = 0;
    aside([&] { error = unshare(CLONE_NEWNET | CLONE_NEWUTS) == 0 ? 0 : errno; });
    if (error == ENOSYS || error == EINVAL) return "the kernel has no network namespaces";
    if (error != 0) return std::string{"no network namespace: "} + std::strerror(error);
    for (const char* program : {"ip", "nft"}) {
        const std::string look = "command -v " + std::string{program} + " >/dev/null";
        if (std::system(look.c_str()) != 0) return std::string{program} + " is missing";  // NOLINT
    }
    return "";
}

std::string whyNoRelay() {
    const int tap = open("/dev/net/tun", O_RDWR | O_CLOEXEC);
    if (tap < 0) return std::string{"/dev/net/tun: "} + std::strerror(errno);
    close(tap);
    return "";
}

Host::Host(const std::string& name) {
    aside([&] {
        if (unshare(CLONE_NEWNET | CLONE_NEWUTS) != 0) fail("a network namespace");
        if (sethostname(name.c_str(), name.size()) != 0) fail("a host name");
        network_ = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
        name_ = open("/proc/thread-self/ns/uts", O_RDONLY | O_CLOEXEC);
        if (network_ < 0 || name_ < 0) fail("/proc/thread-self/ns");
    });
    command("ip link set lo up");
}

Host::~Host() {
    close(network_);
    close(name_);
}

void Host::within(const std::function<void()>& function) const {
    aside([&] {
        if (setns(network_, CLONE_NEWNET) != 0) fail("a network namespace");
        if (setns(name_, CLONE_NEWUTS) != 0) fail("a namespace of host names");
        function();
    });
}

std::string Host::command(const std::string& line) const {
    std::string output;
    within([&] {
        FILE* pipe =
            popen(("{ " + line + "; } 2>&1").c_str(), "r");  // NOLINT: a test runs a program
        if (pipe == nullptr) fail(line);
        std::array<char, 256> text{};
        while (fgets(text.data(), text.size(), pipe) != nullptr) output += text.data();
        if (pclose(pipe) != 0) throw std::runtime_error(line + ": " + output);
    });
    return output;
}

std::string Host::path() const {
    return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(network_);
}

TwoHosts::TwoHosts() {
    first.command("ip link add eth0 type veth peer name eth0 netns " + second.path());
    setUpCards(first, second);
}

void TwoHosts::filter(const std::string& rule) {
    for (const Host* host : {&first, &second}) {
        host->command(
            "nft add table ip test && "
            "nft 'add chain ip test in { type filter hook input priority 0; }' && "
            "nft 'add rule ip test in " +
            rule + "'");
    }
}

void TwoHosts::losePercent(int percent) {
    filter("iifname eth0 numgen random mod 100 < " + std::to_string(percent) + " drop");
}

void TwoHosts::loseAll() { filter("iifname eth0 drop"); }

void TwoHosts::dropMulticast() { filter("ip daddr 224.0.0.0/4 drop"); }

void TwoHosts::passAll() {
    for (const Host* host : {&first, &second}) host->command("nft flush ruleset");
}

// Nobody is there where the route leads. Without a route each question would fail at once.
void TwoHosts::silenceNames() {
    for (const Host* host : {&first, &second}) {
        host->command(
            "ip route add default dev eth0 && nft add table ip names && "
            "nft 'add chain ip names out { type filter hook output priority 0; }' && "
            "nft 'add rule ip names out udp dport 53 counter'");
    }
}

int TwoHosts::askedForNames() const {
    int asked = 0;
    for (const Host* host : {&first, &second}) {
        asked += std::stoi(host->command(
            "nft list table ip names | sed -n 's/.*counter packets \\([0-9]*\\).*/\\1/p'"));
    }
    return asked;
}

DelayedHosts::DelayedHosts() {
    first.within([this] { taps_[0] = makeTap(); });
    second.within([this] { taps_[1] = makeTap(); });
    setUpCards(first, second);
    thread_ = std::thread{[this] { relay(); }};
}

DelayedHosts::~DelayedHosts() {
    stop_ = true;
    thread_.join();
    for (const int tap : taps_) close(tap);
}

void DelayedHosts::relay() {
    struct Frame {
        int to;
        std::uint64_t number;
        std::vector<char> octets;
    };
    std::multimap<Clock::time_point, Frame> onTheirWay;
    std::mt19937 random{1};
    std::uniform_int_distribution<int> delay{10'000, 30'000};
    std::array<std::uint64_t, 2> newest{};
    std::vector<char> buffer(65536);
    while (!stop_) {
        for (auto each = onTheirWay.begin();
             each != onTheirWay.end() && each->first <= Clock::now();
             each = onTheirWay.erase(each)) {
            const Frame& frame = each->second;
            std::uint64_t& last = newest[frame.to == taps_[0]];
            overtaken_ += frame.number < last;
            last = std::max(last, frame.number);
            frames_ += write(frame.to, frame.octets.data(), frame.octets.size()) > 0;
        }
        pollfd ready[] = {{taps_[0], POLLIN, 0}, {taps_[1], POLLIN, 0}};
        poll(ready, 2, 1);
        for (int side = 0; side < 2; ++side) {
            for (ssize_t size; (size = read(taps_[side], buffer.data(), buffer.size())) > 0;) {
                static std::uint64_t number = 0;
                onTheirWay.emplace(
                    Clock::now() + std::chrono::microseconds{delay(random)},
                    Frame{taps_[1 - side], ++number, {buffer.begin(), buffer.begin() + size}});
            }
        }
    }
}

}  // namespace cortex::test
