// SPDX-License-Identifier: Apache-2.0
// An oven at the other end of a pseudo-terminal, until it is ended: `simulated_oven /tmp/oven`.
// Each request takes 20 ms of the oven's time, so that it does the same on any machine.
#include <cstdio>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

namespace {

constexpr double room = 20;        // degrees
constexpr double capacity = 200;   // J/K
constexpr double conductance = 5;  // W/K
constexpr double step = 0.02;      // s

// The end that it serves; the other end has a name, to which `path` leads from now on.
int openLine(const char* path) {
    const int line = posix_openpt(O_RDWR | O_NOCTTY);
    if (line < 0 || grantpt(line) != 0 || unlockpt(line) != 0) return -1;
    const char* const name = ptsname(line);
    // Open at both ends, it outlives those who come and go.
    termios raw{};
    const int other = name == nullptr ? -1 : open(name, O_RDWR | O_NOCTTY);
    if (other < 0 || tcgetattr(other, &raw) != 0) return -1;
    cfmakeraw(&raw);
    tcsetattr(other, TCSANOW, &raw);
    unlink(path);
    return symlink(name, path) == 0 ? line : -1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: simulated_oven PATH\n");
        return 2;
    }
    const int line = openLine(argv[1]);
    if (line < 0) {
        std::perror(argv[1]);
        return 1;
    }
    double temperature = room;
    std::string request;
    for (char next = 0; read(line, &next, 1) == 1;) {
        if (next != '\n') {
            request += next;
            continue;
        }
        const double power = request.starts_with("H ") ? std::atof(request.c_str() + 2) : 0;
        temperature += (power - conductance * (temperature - room)) / capacity * step;
        dprintf(line, "T %.2f\n", temperature);
        request.clear();
    }
    return 0;
}
