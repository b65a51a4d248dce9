// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/network_options.hpp"

#include "style/tokens.hpp"

#include <QSize>
#include <optional>
#include <string>
#include <vector>

namespace cortex::gui {

// What the command line asks for.
struct Options {
    comms::NetworkOptions network;
    std::string person;              // who uses the window; empty: user@host
    std::vector<std::string> paths;  // simplexes to open, each in a tab
    std::vector<std::string> plot;   // items, "/drives/4.position", in one plot
    std::string view;                // as --view lists them
    std::string filter;
    std::string layout;       // a file; empty: the user's own for the domain and its agents
    std::uint32_t rate = 30;  // Hz, of values; 0: every cycle
    Theme theme = Theme::Light;
    double scale = 1;
    QSize size{1280, 800};
    bool sized = false;       // the command line says it
    std::string screenshot;   // a file; the program ends when it is written
    std::string measureFile;  // the program ends when it is written
    double measureSeconds = 0;
    double timeout = 10;  // s that a screenshot waits for everything to come
};

// None: the program ends with `exit`, and all that is to be said was said.
std::optional<Options> parseOptions(int argc, char** argv, int& exit);

}  // namespace cortex::gui
