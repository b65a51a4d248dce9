// SPDX-License-Identifier: Apache-2.0
#include "client.hpp"

#include "cortex/comms/mirror.hpp"
#include "cortex/core/error.hpp"

#include <chrono>
#include <cstdlib>
#include <iostream>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cortex::observers {
namespace {

using namespace std::chrono_literals;

bool told(int milliseconds) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return poll(&input, 1, milliseconds) > 0;
}

std::string lineOf(int descriptor) {
    std::string line;
    for (char next = 0; read(descriptor, &next, 1) == 1 && next != '\n';) line += next;
    return line;
}

std::uint64_t look(comms::Mirror& mirror) {
    const std::uint64_t first = mirror.waitForImage(0, 0ms);
    std::uint64_t last = first;
    while (!told(0)) last = mirror.waitForImage(last, 100ms);
    return last - first;
}

// Spread over the second.
std::uint64_t command(comms::Mirror& mirror, int number) {
    std::uint64_t done = 0;
    if (told(number * 20 % 1000)) return done;
    do {
        const comms::CommandAnswer answer =
            mirror.call("/echo", "ping", {{"number", std::int64_t{number}}});
        if (answer.outcome == Outcome::Done) ++done;
    } while (!told(1000));
    return done;
}

}  // namespace

int runClient(int number, Load load, int domain) {
    comms::NetworkOptions network;
    network.domain = domain;
    network.interfaces = {"127.0.0.1"};
    comms::Mirror mirror{"observer" + std::to_string(number), network};
    if (!mirror.waitForOwner("/echo", 60s)) return 1;
    if (load != Load::Command) {
        mirror.view({"/"}, load == Load::ViewEvery ? 0 : 30);
        if (!mirror.waitForValues(60s)) return 1;
    }
    std::cout << "ready" << std::endl;
    const std::uint64_t count = load == Load::Command ? command(mirror, number) : look(mirror);
    std::cout << count << std::endl;
    return 0;
}

void Clients::start(int number, Load load, int domain) {
    int input[2], output[2];
    if (pipe2(input, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) throw Error("no pipes");
    const std::vector<std::string> words{"cortex-observers", "--client", std::to_string(number),
                                         std::to_string(static_cast<int>(load)),
                                         std::to_string(domain)};
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t process = fork();
    if (process == 0) {
        dup2(input[0], STDIN_FILENO);
        dup2(output[1], STDOUT_FILENO);
        execv("/proc/self/exe", arguments.data());
        _exit(127);
    }
    close(input[0]);
    close(output[1]);
    clients_.push_back({process, input[1], output[0]});
}

void Clients::waitUntilReady() {
    for (const Client& each : clients_) {
        if (lineOf(each.output) != "ready") throw Error("a client was not ready in time");
    }
}

std::vector<std::uint64_t> Clients::stop() {
    std::vector<std::uint64_t> counts;
    for (const Client& each : clients_) close(each.input);
    for (const Client& each : clients_) {
        counts.push_back(std::strtoull(lineOf(each.output).c_str(), nullptr, 10));
        close(each.output);
        waitpid(each.process, nullptr, 0);
    }
    clients_.clear();
    return counts;
}

}  // namespace cortex::observers
