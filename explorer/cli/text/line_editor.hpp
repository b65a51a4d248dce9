// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cortex::cli {

// Lines that a person types on a terminal, with history and completion. It alone knows libedit.
class LineEditor {
public:
    enum class Ended { ByReturn, ByInterrupt, ByEnd };
    struct Hooks {
        std::function<std::string()> prompt;
        // What the word at the end of the text may become.
        std::function<std::vector<std::string>(const std::string& before)> complete;
        // Asked ten times a second: what to show above the line now, or "".
        std::function<std::string()> news;
    };

    LineEditor(Hooks hooks, std::string historyFile);  // "": the history ends with the program
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    Ended read(std::string& line);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace cortex::cli
