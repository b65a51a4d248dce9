// SPDX-License-Identifier: Apache-2.0
// What distribution costs, in one run: the loop thread, the way of a value to another agent,
// discovery, the wire, memory; beside bare Fast DDS or nothing, whatever the machine.
#include "figures.hpp"
#include "roles.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <net/if.h>

using namespace cortex::network;

namespace {

// A loopback interface of this process and its children; false: not permitted.
bool leaveNetwork() {
    if (unshare(CLONE_NEWNET) != 0) return false;
    const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ifreq request{};
    std::strcpy(request.ifr_name, "lo");
    request.ifr_flags = IFF_UP | IFF_RUNNING;
    const bool up = ioctl(any, SIOCSIFFLAGS, &request) == 0;
    close(any);
    return up;
}

struct Part {
    const char* name;
    void (*measure)(const Options& options);
};
constexpr std::array parts{Part{"loop", loopCost}, Part{"latency", latency},
                           Part{"discovery", discovery}, Part{"wire", wire},
                           Part{"memory", footprint}};

void run(Options options, std::string_view wanted) {
    options.alone = leaveNetwork();
    options.domain = options.alone ? 1 : 1 + getpid() % 99;
    double load = 0;
    getloadavg(&load, 1);
    std::cout << "load " << load << " on " << sysconf(_SC_NPROCESSORS_ONLN)
              << " CPUs; loopback interface "
              << (options.alone ? "of its own" : "of the machine, with its other users") << '\n';
    for (const Part& part : parts) {
        if (wanted.empty() || wanted == part.name) part.measure(options);
    }
    getloadavg(&load, 1);
    std::cout << "\nload " << load << " at the end, this program included\n";
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::vector<std::string> words{argv + 1, argv + argc};
        if (!words.empty() && words[0].starts_with("--")) return playRole(words);
        Options options;
        if (!words.empty()) options.seconds = std::atoi(words[0].c_str());
        const std::string wanted = words.size() > 1 ? words[1] : "";
        const bool known =
            wanted.empty() || std::ranges::find(parts, wanted, &Part::name) != parts.end();
        if (words.size() > 2 || options.seconds < 1 || !known) {
            std::cerr << "usage: cortex-network-figures [SECONDS of each measurement"
                         " [loop|latency|discovery|wire|memory]]\n";
            return 2;
        }
        run(options, wanted);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "error: " << error.what() << '\n';
        return 1;
    }
}
