// SPDX-License-Identifier: Apache-2.0
#include "tcp_socket.hpp"

#include "cortex/toolkit/fieldbus_link.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <poll.h>
#include <sys/select.h>
#include <unistd.h>

#include <netinet/tcp.h>

namespace cortex::modbus {
namespace {

class Socket {
public:
    explicit Socket(int file) : file_{file} {}
    ~Socket() {
        if (file_ >= 0) ::close(file_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    int get() const { return file_; }
    int release() { return std::exchange(file_, -1); }

private:
    int file_;
};

// How connecting ended: an errno, 0 for well.
int waitConnected(int socket, std::chrono::milliseconds time) {
    pollfd connected{socket, POLLOUT, 0};
    const int count = poll(&connected, 1, static_cast<int>(time.count()));
    if (count < 0) return errno;
    if (count == 0) return ETIMEDOUT;
    int error = 0;
    socklen_t length = sizeof error;
    if (getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &length) != 0) return errno;
    return error;
}

std::string reason(int error, std::chrono::milliseconds time) {
    if (error == ECONNREFUSED) return "nobody listens there; start the device, or correct address";
    if (error == ETIMEDOUT) {
        return "nobody answered within " + std::to_string(time.count()) +
               " ms; is it switched on, and the cable plugged in?";
    }
    return std::string{std::strerror(error)} + "; look at network and address";
}

}  // namespace

int connectTo(const ModbusAddress& server, std::chrono::milliseconds time) {
    const auto fail = [&](const std::string& why) {
        throw toolkit::LinkError(server.text() + ": " + why);
    };
    Socket made{socket(server.socketAddress()->sa_family,
                       SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, IPPROTO_TCP)};
    if (made.get() < 0) fail(reason(errno, time));
    if (made.get() >= FD_SETSIZE) {  // libmodbus waits by select()
        fail("this process has " + std::to_string(FD_SETSIZE) +
             " files open or more; run the device in an agent of its own");
    }
    const int noDelay = 1;
    setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &noDelay, sizeof noDelay);
    int error = 0;
    if (connect(made.get(), server.socketAddress(), server.length()) != 0) error = errno;
    if (error == EINPROGRESS) error = waitConnected(made.get(), time);
    if (error != 0) fail(reason(error, time));
    return made.release();
}

}  // namespace cortex::modbus
