// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/patience.hpp"

#include <chrono>
#include <string>
#include <vector>

#include <sys/types.h>

namespace cortex::test {

// A program on a terminal of its own, with what it wrote.
class OnTerminal {
public:
    explicit OnTerminal(std::vector<std::string> command, unsigned short columns = 120,
                        unsigned short rows = 40);
    ~OnTerminal();
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    // Reads until it has written this since the last mark, has ended, or that time is over. It
    // looks for the next text behind this one.
    bool shows(const std::string& text, std::chrono::seconds within = patience);
    void mark() { from_ = output_.size(); }
    void type(const std::string& keys);
    void signal(int number);
    // Waits for its end, while patience lasts, and gives its code, or minus the signal that ended
    // it. It types the keys each second: what is typed while a line editor changes the terminal's
    // mode is lost.
    int exit(const std::string& keys = {});
    const std::string& output() const { return output_; }

private:
    int terminal_ = -1, status_ = 0;
    pid_t child_ = 0;
    std::string output_;
    std::size_t from_ = 0;  // where shows() looks
};

}  // namespace cortex::test
