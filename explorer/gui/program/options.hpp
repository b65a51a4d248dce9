// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "style/tokens.hpp"

#include <QSize>
#include <optional>
#include <string>
#include <vector>

namespace cortex::explorer {

// What the command line asks for.
struct Options {
    comms::NetworkOptions network;
    std::vector<std::string> paths;  // simplexes to open, each in a tab
    std::string view;                // as --view lists them
    std::string filter;
    std::uint32_t rate = 30;  // Hz, of values; 0: every cycle
    Theme theme = Theme::Light;
    double scale = 1;
    QSize size{1280, 800};
    std::string screenshot;  // a file; the program ends when it is written
    double timeout = 10;     // s that a screenshot waits for everything to come
};

// None: the program ends with `exit`, and all that is to be said was said.
std::optional<Options> parseOptions(int argc, char** argv, int& exit);

}  // namespace cortex::explorer
