// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/controlled_agent.hpp"
#include "cli/on_terminal.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cortex::test {

// `cortex shell` on a terminal of its own, on the network of this test.
struct TypedShell : OnTerminal {
    // In its home; `person`: who uses it.
    explicit TypedShell(const ModelFolder& folder, const std::string& person = "somebody")
        : OnTerminal{std::vector<std::string>{"/usr/bin/env", "HOME=" + folder.path().string()} +
                     cortexCommand({"shell", "--name", person})},
          who{person} {
        EXPECT_TRUE(shows("cortex> ")) << output();
        const std::string before = "you are " + person + " (";
        const std::size_t begin = output().find(before) + before.size();
        name = output().substr(begin, output().find(") in domain", begin) - begin);
        who += " (" + name + ")";
    }
    // Types keys again each second until they have this effect: what comes while the line editor
    // changes the terminal's mode is lost. Control-U begins the line anew.
    void typeUntil(const std::string& keys, const std::string& shown) {
        mark();
        for (std::chrono::seconds waited{0}; waited < patience; ++waited) {
            type("\x15" + keys);
            if (shows(shown, std::chrono::seconds{1})) return;
        }
        ADD_FAILURE() << "it does not show " << shown << ": " << output();
    }
    void typeLine(const std::string& line) { typeUntil(line, line); }  // until it is echoed
    void enter(const std::string& line) {
        typeLine(line);
        type("\r");
    }
    // Enters a line and waits for what it prints, or for the prompt that follows.
    void run(const std::string& line, const std::string& expected) {
        enter(line);
        EXPECT_TRUE(shows(expected)) << output();
        const bool prompt = expected.starts_with("cortex");
        EXPECT_TRUE(prompt || shows("> ")) << output();
    }

    std::string name, who;  // of the tool, and of both
};

}  // namespace cortex::test
