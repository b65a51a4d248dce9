// SPDX-License-Identifier: Apache-2.0
#include "keyboard_hand.hpp"

#include "cortex/core/error.hpp"

#include <string_view>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace cortex::toolkit {
namespace {

constexpr std::string_view motionKeys = "wsadqeuoikjl";  // plus and minus of each axis
constexpr std::int64_t keyLasts = 120'000'000;           // ns, longer than a terminal's key repeat

}  // namespace

KeyboardHand::KeyboardHand() {
    if (!isatty(STDIN_FILENO)) {
        throw Error(
            "the keyboard as source needs a terminal as standard input; "
            "otherwise set source to 0 and give a file");
    }
    thread_ = std::thread{[this] { run(); }};
}

KeyboardHand::~KeyboardHand() {
    ending_ = true;
    thread_.join();
}

void KeyboardHand::run() {
    termios before{};
    tcgetattr(STDIN_FILENO, &before);
    termios raw = before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    while (!ending_) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        char key = 0;
        if (poll(&input, 1, 50) > 0 && ::read(STDIN_FILENO, &key, 1) == 1) take(key);
    }
    tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

void KeyboardHand::take(char key) {
    if (key == ' ') pressed_ = !pressed_;
    const std::size_t index = motionKeys.find(key);
    if (index == std::string_view::npos) return;
    Axis& axis = axes_[index / 2];
    axis.direction = index % 2 == 0 ? 1 : -1;
    ++axis.strokes;
}

std::array<double, KeyboardHand::axisCount> KeyboardHand::motion(std::int64_t cycleTime) {
    std::array<double, axisCount> motion{};
    for (std::size_t i = 0; i < axisCount; ++i) {
        Axis& axis = axes_[i];
        const std::int64_t strokes = axis.strokes;
        if (strokes != axis.seen) axis.until = cycleTime + keyLasts;
        axis.seen = strokes;
        if (cycleTime < axis.until) motion[i] = axis.direction;
    }
    return motion;
}

}  // namespace cortex::toolkit
