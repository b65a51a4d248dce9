// SPDX-License-Identifier: Apache-2.0
#include "text/terminal.hpp"

#include "cortex/core/error.hpp"

#include <cerrno>
#include <cstdlib>
#include <string_view>

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace cortex::cli {
namespace {

void writeAll(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(STDOUT_FILENO, text.data(), text.size());
        if (written < 0 && errno != EINTR) return;  // nobody looks any more
        if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
}

winsize sizeOfTerminal() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) size = {};
    return size;
}

}  // namespace

Signals::Signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int each : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGWINCH}) sigaddset(&set, each);
    pthread_sigmask(SIG_BLOCK, &set, &before_);
    file_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
    if (file_ < 0) throw Error("cannot receive signals: no file handle is free");
}

Signals::~Signals() {
    close(file_);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

Woken Signals::read() {
    signalfd_siginfo info{};
    Woken woken = Woken::ByTime;
    while (::read(file_, &info, sizeof info) == sizeof info) {
        if (info.ssi_signo != SIGWINCH) return Woken::BySignal;
        woken = Woken::BySize;
    }
    return woken;
}

Woken Signals::wait(std::chrono::milliseconds limit, bool keys) {
    pollfd files[]{{file_, POLLIN, 0}, {keys ? STDIN_FILENO : -1, POLLIN, 0}};
    if (poll(files, 2, static_cast<int>(limit.count())) <= 0) return Woken::ByTime;
    if (files[0].revents != 0) return read();
    if (::read(STDIN_FILENO, &key_, 1) == 1) return Woken::ByKey;
    return Woken::BySignal;  // the terminal is gone
}

bool Screen::possible() {
    const char* terminal = std::getenv("TERM");
    const bool places = terminal != nullptr && std::string_view{terminal} != "dumb";
    return places && isatty(STDOUT_FILENO) == 1;
}

std::size_t Screen::columns() {
    const winsize size = sizeOfTerminal();
    return size.ws_col > 0 ? size.ws_col : 80;
}

std::size_t Screen::rows() {
    const winsize size = sizeOfTerminal();
    return size.ws_row > 0 ? size.ws_row : 24;
}

// Suspending (Ctrl-Z) is off: the screen would stay.
void Screen::enter() {
    termios now{};
    if (isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &now) == 0) {
        before_ = now;
        now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        now.c_cc[VMIN] = 1;
        now.c_cc[VTIME] = 0;
        now.c_cc[VSUSP] = _POSIX_VDISABLE;
        tcsetattr(STDIN_FILENO, TCSANOW, &now);
    }
    writeAll("\033[?1049h\033[?25l\033[?7l\033[2J");  // screen, no cursor, no wrapping, empty
}

void Screen::leave() {
    writeAll("\033[?7h\033[?25h\033[?1049l");
    if (before_) tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

void Screen::show(const std::string& lines) {
    std::string text = "\033[H";
    for (const char c : lines) {
        if (c == '\n') text += "\033[K";
        text += c;
    }
    writeAll(text + "\033[K\033[J");
}

}  // namespace cortex::cli
